// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_DIELECTRIC_SURFACE_H
#define WEFT_SCENE_SURFACE_DIELECTRIC_SURFACE_H

#include "scene/surface/absorption.h"
#include "scene/surface/microfacets.h"
#include "scene/surface/roughness.h"

namespace weft {

/// A clear boundary between two indices of refraction: Mitsuba's dielectric, roughdielectric and
/// thindielectric, and glass of MTL files.
struct DielectricSurface {
    double ior_inside = 1.5;          ///< behind the outside of the triangles
    double ior_outside = 1.0;         ///< before them
    ColourParameter reflectance{};    ///< multiplied with what is reflected
    ColourParameter transmittance{};  ///< multiplied with what passes
    Roughness roughness_u{ScalarParameter{0.0F}, RoughnessScale::alpha};
    Roughness roughness_v{ScalarParameter{0.0F}, RoughnessScale::alpha};
    Microfacets microfacets{};
    bool thin = false;         ///< a wall of no thickness, with reflections between its two sides
    bool local_index = false;  ///< the indices are as given here, whatever is around
};

}  // namespace weft

#endif
