// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_NOISE_TEXTURE_H
#define WEFT_TESTS_TESTING_NOISE_TEXTURE_H

#include <algorithm>
#include <cstdint>
#include <random>

#include "scene/mip_levels.h"
#include "scene/scene.h"

namespace weft::test {

/// A texture of random bytes from `low` to `high`.
inline Texture noise_texture(std::uint32_t width, std::uint32_t height, bool srgb, int low = 0,
                             int high = 255) {
    Texture texture;
    texture.width = width;
    texture.height = height;
    texture.srgb = srgb;
    std::mt19937 engine(17);
    std::uniform_int_distribution<int> byte(low, high);
    texture.rgba.resize(std::size_t{4} * width * height);
    for (std::uint8_t& value : texture.rgba) value = static_cast<std::uint8_t>(byte(engine));
    return texture;
}

/// The linear value of a byte of a colour, of those below 0 and above 255 that of the nearest.
inline double linear_of(int byte, bool srgb) {
    const int inside = std::clamp(byte, 0, 255);
    return srgb ? static_cast<double>(srgb_to_linear(static_cast<std::uint8_t>(inside)))
                : inside / 255.0;
}

}  // namespace weft::test

#endif
