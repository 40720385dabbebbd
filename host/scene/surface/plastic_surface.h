// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_PLASTIC_SURFACE_H
#define WEFT_SCENE_SURFACE_PLASTIC_SURFACE_H

#include "scene/surface/microfacets.h"
#include "scene/surface/roughness.h"

namespace weft {

/// A diffuse base below a dielectric (Mitsuba's plastic and roughplastic).
struct PlasticSurface {
    double ior_inside = 1.49;
    double ior_outside = 1.0;
    ColourParameter diffuse{glm::vec3(0.5F)};  ///< reflectance of the base
    ColourParameter specular{};                ///< multiplied with what the boundary reflects
    Roughness roughness{ScalarParameter{0.0F}, RoughnessScale::alpha};
    Microfacets microfacets{};
    bool nonlinear =
        false;  ///< the base is coloured at each of many reflections below the boundary
};

}  // namespace weft

#endif
