// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_CONDUCTOR_SURFACE_H
#define WEFT_SCENE_SURFACE_CONDUCTOR_SURFACE_H

#include <glm/glm.hpp>

#include "scene/surface/microfacets.h"
#include "scene/surface/roughness.h"

namespace weft {

/// A metal by its complex index of refraction eta + i k (Mitsuba's conductor and roughconductor).
struct ConductorSurface {
    glm::vec3 eta{0.0F};
    glm::vec3 k{1.0F};
    ColourParameter reflectance{};  ///< multiplied with what Fresnel's equations give
    Roughness roughness_u{ScalarParameter{0.0F}, RoughnessScale::alpha};  ///< along u
    Roughness roughness_v{ScalarParameter{0.0F}, RoughnessScale::alpha};
    Microfacets microfacets{};
};

}  // namespace weft

#endif
