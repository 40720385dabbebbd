// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tev/tev_packet.h"

#include <bit>
#include <limits>
#include <utility>

namespace weft {
namespace {

// Kinds of packets.
constexpr std::uint8_t create_kind = 4;
constexpr std::uint8_t update_kind = 6;  // the third version, which has strides

/// A packet: its length as four bytes, itself and `following` included, its kind and its fields,
/// little-endian.
class Packet {
  public:
    explicit Packet(std::uint8_t kind) : bytes_(sizeof(std::uint32_t)) { put(kind); }

    template <typename Number>
    void put(Number number) {
        static_assert(std::endian::native == std::endian::little);
        const auto* const begin = reinterpret_cast<const std::byte*>(&number);
        bytes_.insert(bytes_.end(), begin, begin + sizeof(number));
    }
    void put_bool(bool value) { put(static_cast<std::uint8_t>(value ? 1 : 0)); }
    void put_text(const std::string& text) {
        for (const char c : text) put(c);
        put('\0');
    }
    void put_channels(std::span<const std::string> channels) {
        put(static_cast<std::int32_t>(channels.size()));
        for (const std::string& channel : channels) put_text(channel);
    }

    [[nodiscard]] std::vector<std::byte> finish(std::uint64_t following) {
        const auto word = static_cast<std::uint32_t>(bytes_.size() + following);
        for (std::size_t i = 0; i < sizeof(word); ++i)
            bytes_[i] = static_cast<std::byte>(word >> (8 * i) & 0xFFU);
        return std::move(bytes_);
    }

  private:
    std::vector<std::byte> bytes_;
};

}  // namespace

std::vector<std::byte> tev_create(const std::string& image, std::uint32_t width,
                                  std::uint32_t height, std::span<const std::string> channels) {
    Packet packet(create_kind);
    packet.put_bool(true);  // tev shows the image at once
    packet.put_text(image);
    packet.put(static_cast<std::int32_t>(width));
    packet.put(static_cast<std::int32_t>(height));
    packet.put_channels(channels);
    return packet.finish(0);
}

std::vector<std::byte> tev_update_head(const std::string& image, std::uint32_t width,
                                       std::uint32_t height,
                                       std::span<const std::string> channels) {
    const std::uint64_t plane = std::uint64_t{width} * height;
    Packet packet(update_kind);
    packet.put_bool(false);  // whichever image the user looks at stays
    packet.put_text(image);
    packet.put_channels(channels);
    for (const std::uint32_t place : {0U, 0U, width, height})
        packet.put(static_cast<std::int32_t>(place));
    for (std::uint64_t channel = 0; channel < channels.size(); ++channel)
        packet.put(static_cast<std::int64_t>(channel * plane));
    for (std::uint64_t channel = 0; channel < channels.size(); ++channel)
        packet.put(std::int64_t{1});
    return packet.finish(channels.size() * plane * sizeof(float));
}

bool tev_can_update(std::uint32_t width, std::uint32_t height, std::size_t channels) {
    constexpr std::uint64_t for_names = 1U << 20;
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - for_names;
    return std::uint64_t{width} * height <= most / sizeof(float) / channels;
}

}  // namespace weft
