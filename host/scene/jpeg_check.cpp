// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/jpeg_check.h"

#include <cstdint>

#include "base/error.h"

namespace weft {
namespace {

constexpr std::uint32_t start_of_image = 0xD8;
constexpr std::uint32_t end_of_image = 0xD9;
constexpr std::uint32_t start_of_scan = 0xDA;
constexpr std::uint32_t huffman_tables = 0xC4;

/// Steps from segment to segment as the decoder does, so that neither sees one the other skips.
class JpegWalk {
  public:
    JpegWalk(std::span<const std::byte> bytes, const std::string& place)
        : bytes_(bytes), place_(place) {}

    void check() {
        constexpr std::size_t max_scans = 64;
        if (byte(0) == 0xFF) walk();
        if (scans_ > max_scans)
            throw input_error(place_, "JPEG picture with " + std::to_string(scans_) +
                                          " scans, expected at most " + std::to_string(max_scans));
    }

  private:
    void walk() {
        std::size_t at = 0;
        if (next_marker(at) != start_of_image) return;
        while (at < bytes_.size()) {
            const std::uint32_t marker = next_marker(at);
            if (marker == end_of_image) return;
            if (marker == huffman_tables) check_tables(at);
            const std::size_t length = word(at);
            if (length < 2) return;  // the decoder stops here, too
            at += length;
            if (marker == start_of_scan) skip_scan(at);
        }
    }

    /// The decoder reads zeros beyond the end.
    [[nodiscard]] std::uint32_t byte(std::size_t at) const {
        return at < bytes_.size() ? std::to_integer<std::uint32_t>(bytes_[at]) : 0;
    }
    [[nodiscard]] std::uint32_t word(std::size_t at) const { return byte(at) << 8 | byte(at + 1); }

    std::uint32_t next_marker(std::size_t& at) const {
        while (at < bytes_.size() && byte(at) != 0xFF) ++at;
        while (at < bytes_.size() && byte(at) == 0xFF) ++at;
        return byte(at++);
    }

    /// To the next marker that does not belong to the coded data.
    void skip_scan(std::size_t& at) {
        ++scans_;
        for (; at < bytes_.size(); ++at) {
            const std::uint32_t next = byte(at + 1);
            const bool restart = next >= 0xD0 && next <= 0xD7;
            if (byte(at) == 0xFF && next != 0 && next != 0xFF && !restart) return;
        }
    }

    /// Tables follow one another as long as something of the stated length is left.
    void check_tables(std::size_t at) const {
        constexpr std::size_t max_symbols = 256;
        auto left = static_cast<std::int64_t>(word(at)) - 2;
        at += 2;
        while (left > 0) {
            std::size_t symbols = 0;
            for (std::size_t i = 1; i <= 16; ++i) symbols += byte(at + i);
            if (symbols > max_symbols)
                throw input_error(place_, "JPEG picture with a Huffman table of " +
                                              std::to_string(symbols) +
                                              " symbols, expected at most 256");
            at += 17 + symbols;
            left -= static_cast<std::int64_t>(17 + symbols);
        }
    }

    std::span<const std::byte> bytes_;
    const std::string& place_;
    std::size_t scans_ = 0;
};

}  // namespace

void check_jpeg(std::span<const std::byte> bytes, const std::string& place) {
    JpegWalk(bytes, place).check();
}

}  // namespace weft
