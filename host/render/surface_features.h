// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_SURFACE_FEATURES_H
#define WEFT_RENDER_SURFACE_FEATURES_H

#include <cstdint>

#include "scene/flat_scene.h"
#include "shared/shared_types.h"

namespace weft {

/// FEATURE_* of the surfaces and the environment that rays hit, which every algorithm needs.
[[nodiscard]] inline std::uint32_t surface_features(const FlatScene& scene) {
    return scene.features & (FEATURE_TEXTURES | FEATURE_VERTEX_COLOURS | FEATURE_SMOOTH_NORMALS |
                             FEATURE_ONE_SIDED | FEATURE_LOBES | FEATURE_EMISSION_TEXTURES |
                             FEATURE_ENVIRONMENT | FEATURE_IMAGE_ENVIRONMENT);
}

}  // namespace weft

#endif
