// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_ANISOTROPY_H
#define WEFT_SCENE_SURFACE_ANISOTROPY_H

#include "scene/surface/texture_map.h"

namespace weft {

/// How a surface's roughness depends on direction: along the tangent, turned by `rotation`, alpha
/// is mixed towards 1 by the square of `strength`; across it, alpha is that of the roughness.
struct Anisotropy {
    float strength = 0.0F;  ///< [0, 1], times blue of the map
    float rotation = 0.0F;  ///< radians, counter-clockwise from the tangent
    TextureMap map{};  ///< direction in red and green, from [0, 1] to [-1, 1]; strength in blue
};

}  // namespace weft

#endif
