// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MIP_LEVELS_H
#define WEFT_SCENE_MIP_LEVELS_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace weft {

/// One level of a texture in linear light, 3 floats a texel, row by row.
struct LinearLevel {
    std::uint32_t width, height;
    std::vector<float> values;
};

/// A texture and its ever smaller averages, down to one texel. Each level halves the edges (rounded
/// down, at least 1); a texel is the mean over the texels of the level before that it covers.
[[nodiscard]] std::vector<LinearLevel> linear_mip_levels(const Texture& texture);

/// Appends a texture and its ever smaller averages, down to one texel, as kernels read them: red in
/// the lowest byte, alpha in the highest where Texture::has_alpha, else 0. The levels are those of
/// linear_mip_levels; alpha has its own averages.
void append_mip_levels(const Texture& texture, std::vector<std::uint32_t>& texels);

/// How many texels that appends.
[[nodiscard]] std::size_t mip_texels(std::uint32_t width, std::uint32_t height);

/// Linear value of an sRGB byte (IEC 61966-2-1).
[[nodiscard]] float srgb_to_linear(std::uint8_t value);

/// The sRGB byte nearest to a linear value in [0, 1].
[[nodiscard]] std::uint8_t linear_to_srgb(float value);

/// `srgb_to_linear` of every byte.
[[nodiscard]] std::vector<float> srgb_table();

}  // namespace weft

#endif
