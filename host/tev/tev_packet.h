// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TEV_TEV_PACKET_H
#define WEFT_TEV_TEV_PACKET_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// The packet that makes tev show an image of that name, black so far, in place of one of the same
/// name. tev is an image viewer that other programs send images to by TCP:
/// https://github.com/Tom94/tev. Names hold no NUL.
[[nodiscard]] std::vector<std::byte> tev_create(const std::string& image, std::uint32_t width,
                                                std::uint32_t height,
                                                std::span<const std::string> channels);

/// The packet that sets some channels of an image, but for the values at its end, `width` x
/// `height` floats of each channel, row-major, top row first, one channel after the other. Only
/// where tev_can_update().
[[nodiscard]] std::vector<std::byte> tev_update_head(const std::string& image, std::uint32_t width,
                                                     std::uint32_t height,
                                                     std::span<const std::string> channels);

/// Whether so many channels of an image fit into a packet, whose length has 32 bits.
[[nodiscard]] bool tev_can_update(std::uint32_t width, std::uint32_t height, std::size_t channels);

}  // namespace weft

#endif
