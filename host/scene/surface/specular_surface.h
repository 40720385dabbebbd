// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_SPECULAR_SURFACE_H
#define WEFT_SCENE_SURFACE_SPECULAR_SURFACE_H

#include "scene/surface/roughness.h"

namespace weft {

/// A diffuse surface below one that reflects `specular` at normal incidence, rising to white at
/// grazing angles: KHR_materials_pbrSpecularGlossiness, and MTL files with Ks.
struct SpecularSurface {
    ColourParameter diffuse{};   ///< times vertex colour
    ColourParameter specular{};  ///< f0
    Roughness roughness{};
    /// The diffuse colour is multiplied by 1 less the largest channel of `specular`.
    bool diffuse_is_scaled = false;
};

}  // namespace weft

#endif
