// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_NORMAL_MAP_H
#define WEFT_SCENE_SURFACE_NORMAL_MAP_H

#include "scene/surface/texture_map.h"

namespace weft {

/// A texture of normals in the frame of tangent, bitangent and normal: a colour c in [0, 1] is the
/// vector 2c - 1, whose first two components are multiplied by `scale`.
struct NormalMap {
    TextureMap map{};
    float scale = 1.0F;
    /// Whether the bitangent is the normal times the tangent, as in Mitsuba, whichever way the
    /// texture runs; false: a mirrored texture has it the other way, as in glTF.
    bool mitsuba_frame = false;
    bool mitsuba_shadowing = false;  ///< Mitsuba's factor of shadowing by the tilted facets
    bool mitsuba_flip = false;       ///< its flip of normals that face away

    [[nodiscard]] bool present() const { return map.present(); }
};

}  // namespace weft

#endif
