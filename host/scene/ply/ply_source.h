// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_PLY_PLY_SOURCE_H
#define WEFT_SCENE_PLY_PLY_SOURCE_H

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

#include "scene/ply/ply_header.h"

namespace weft {

/// Values of a binary PLY body, one after the other.
class PlyBinarySource {
  public:
    PlyBinarySource(std::string_view body, bool big_endian)
        : rest_(body), swap_(big_endian != (std::endian::native == std::endian::big)) {}

    /// The next value; nothing where the file ends.
    std::optional<double> next(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return take<std::int8_t>();
            case PlyType::uint8:
                return take<std::uint8_t>();
            case PlyType::int16:
                return take<std::int16_t>();
            case PlyType::uint16:
                return take<std::uint16_t>();
            case PlyType::int32:
                return take<std::int32_t>();
            case PlyType::uint32:
                return take<std::uint32_t>();
            case PlyType::float32:
                return take<float>();
            case PlyType::float64:
                break;
        }
        return take<double>();
    }

    /// Skips values of one type; false where fewer are left.
    bool skip(PlyType type, std::uint64_t count) {
        if (count > capacity(ply_size(type))) return false;
        rest_.remove_prefix(static_cast<std::size_t>(count) * ply_size(type));
        return true;
    }

    /// How many items of at least `bytes` bytes the rest of the file can hold.
    [[nodiscard]] std::uint64_t capacity(std::size_t bytes) const { return rest_.size() / bytes; }

    /// The fewest bytes that a value takes.
    [[nodiscard]] static std::size_t least_size(PlyType type) { return ply_size(type); }

    /// Bytes after the values read so far.
    [[nodiscard]] std::size_t left() const { return rest_.size(); }

    /// There are no lines.
    [[nodiscard]] static std::optional<std::size_t> line() { return std::nullopt; }

  private:
    template <typename Value>
    std::optional<double> take() {
        std::array<char, sizeof(Value)> bytes{};
        if (rest_.size() < bytes.size()) return std::nullopt;
        std::memcpy(bytes.data(), rest_.data(), bytes.size());
        if (swap_) std::reverse(bytes.begin(), bytes.end());
        rest_.remove_prefix(bytes.size());
        return static_cast<double>(std::bit_cast<Value>(bytes));
    }

    std::string_view rest_;
    bool swap_;
};

/// Values of an ascii PLY body, separated by blanks and line ends.
class PlyAsciiSource {
  public:
    explicit PlyAsciiSource(std::string_view body) : body_(body), rest_(body) { skip_blanks(); }

    /// The next value; nothing where the file ends or holds no number.
    std::optional<double> next(PlyType /*type*/) {
        // Where the file ends, the last value stays the place of what is wrong.
        if (!rest_.empty()) last_ = body_.size() - rest_.size();
        if (!rest_.empty() && rest_.front() == '+') rest_.remove_prefix(1);
        double value = 0.0;
        const char* const end = rest_.data() + rest_.size();
        const auto [stop, code] = std::from_chars(rest_.data(), end, value);
        if (code == std::errc::invalid_argument) return std::nullopt;
        if (stop != end && blanks.find(*stop) == std::string_view::npos) return std::nullopt;
        // Too large and too small numbers are not told apart; neither is of use as a coordinate.
        if (code != std::errc()) value = std::numeric_limits<double>::quiet_NaN();
        rest_.remove_prefix(static_cast<std::size_t>(stop - rest_.data()));
        skip_blanks();
        return value;
    }

    /// Skips values; false where fewer are left.
    bool skip(PlyType type, std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) {
            if (!next(type)) return false;
        }
        return true;
    }

    /// How many items of at least `bytes` bytes the rest of the file can hold. The last value
    /// needs no separator.
    [[nodiscard]] std::uint64_t capacity(std::size_t bytes) const {
        return (rest_.size() + 1) / bytes;
    }

    /// A digit and a separator.
    [[nodiscard]] static std::size_t least_size(PlyType /*type*/) { return 2; }

    /// Bytes after the values read so far, without blanks.
    [[nodiscard]] std::size_t left() const { return rest_.size(); }

    /// Line of the body, from 0, of the value that was read last or is no number.
    [[nodiscard]] std::optional<std::size_t> line() const {
        const std::string_view before = body_.substr(0, last_);
        return static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
    }

  private:
    static constexpr std::string_view blanks = " \t\r\n\v\f";

    void skip_blanks() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
    }

    std::string_view body_;
    std::string_view rest_;
    std::size_t last_ = 0;  ///< byte at which the value that was read last begins
};

}  // namespace weft

#endif
