// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_FLOOR_SCENES_H
#define WEFT_TESTS_TESTING_FLOOR_SCENES_H

#include "selftest/floor_scenes.h"
#include "tests/testing/closed_forms.h"

namespace weft::test {

using namespace selftest;

/// 70 small area lights above a floor, and a sun that shines from below and outshines them by 2^40.
/// The irradiance of the floor at the origin is that of the area lights.
inline LitFloor faint_area_lights_beside_a_sun() {
    SceneBuilder builder = floor_scene();
    const std::uint32_t material = builder.material(glm::vec3(0.0F), radiance);
    const std::uint32_t bright = builder.material(glm::vec3(0.0F), 3.0F * radiance);
    glm::dvec3 irradiance(0.0);
    for (int i = 0; i < 70; ++i) {
        const Mesh area_light =
            quad_mesh({-0.5F + 0.1F * float(i % 10), -0.5F + 0.14F * float(i / 10), 1.0F},
                      {0.0F, 0.1F, 0.0F}, {0.08F, 0.0F, 0.0F});
        builder.add(area_light, i % 3 == 0 ? bright : material);
        irradiance += polygon_irradiance(corners_of(area_light), {0, 0, 0}, {0, 0, 1}) *
                      (i % 3 == 0 ? 3.0 : 1.0) * glm::dvec3(radiance);
    }
    builder.light(LightType::directional, {}, glm::vec3(0x1p40F)).direction = {0.0, 0.0, 1.0};
    return {std::move(builder.scene), irradiance, 0.0};
}

}  // namespace weft::test

#endif
