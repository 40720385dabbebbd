// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_WRITE_JPEG_H
#define WEFT_IMAGE_WRITE_JPEG_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// How much of an image a JPEG keeps.
struct JpegSettings {
    int quality = 92;            ///< 1 to 100, as libjpeg counts it
    bool halves_colour = false;  ///< colour, but not brightness, at half the size both ways (4:2:0)
};

/// An 8-bit image as a JPEG file. `colours`: row-major, top row first; red in the lowest byte, then
/// green and blue; the fourth byte counts for nothing. Throws std::runtime_error where libjpeg
/// refuses, as above 65500 pixels each way, and std::bad_alloc.
[[nodiscard]] std::vector<std::byte> jpeg_bytes(std::span<const std::uint32_t> colours,
                                                std::uint32_t width, std::uint32_t height,
                                                const JpegSettings& settings);

}  // namespace weft

#endif
