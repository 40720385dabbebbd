// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_TEXTURE_STATISTICS_H
#define WEFT_SCENE_TEXTURE_STATISTICS_H

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace weft {

/// The least and the greatest of some values.
struct ValueRange {
    double least = 0.0;
    double most = 1.0;
};

/// Means and ranges of all texels of a texture: linear values in [0, 1]. By default those of a
/// texture of which nothing is known.
struct TextureStatistics {
    glm::dvec4 mean{1.0};                ///< red, green, blue, alpha
    std::array<ValueRange, 4> ranges{};  ///< the same
    ValueRange luminance{};

    /// The mean and the range of a channel. As a number kernels read Channel::rgb by its red.
    [[nodiscard]] double mean_of(Channel channel) const;
    [[nodiscard]] ValueRange range_of(Channel channel) const;
};

/// Looks at all texels of a texture, by all cores.
[[nodiscard]] TextureStatistics measure_texture(const Texture& texture);

/// By texture; nothing is known of those that are not `shown`.
[[nodiscard]] std::vector<TextureStatistics> measure_textures(std::span<const Texture> textures,
                                                              const std::vector<bool>& shown);

}  // namespace weft

#endif
