// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_SURFACE_PARAMETER_H
#define WEFT_SCENE_SURFACE_SURFACE_PARAMETER_H

#include <glm/glm.hpp>

#include "scene/surface/texture_map.h"

namespace weft {

/// A colour of a surface, linear Rec.709: a factor in [0, 1] times the colour of a texture.
struct ColourParameter {
    glm::vec3 factor{1.0F};
    TextureMap map{};
};

/// A number of a surface: a factor times one channel of a texture.
struct ScalarParameter {
    float factor = 1.0F;
    TextureMap map{};

    /// Whether it is 0 wherever the surface is, whatever the texture.
    [[nodiscard]] bool is_zero() const { return factor == 0.0F; }
};

}  // namespace weft

#endif
