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

/// Two texels beside each other: black, and the linear colour of these bytes.
inline Texture black_beside(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.srgb = false;
    texture.nearest = true;
    texture.wrap_u = Wrap::clamp;
    texture.rgba = {0, 0, 0, 255, r, g, b, 255};
    return texture;
}

/// A square above the floor whose texture makes it shine in the half y > 0 alone, in cells some of
/// which are dark, some bright, and some both.
inline Scene half_bright_square() {
    SceneBuilder builder = floor_scene();
    builder.scene.textures.push_back(black_beside(51, 255, 255));
    const std::uint32_t material = builder.material(glm::vec3(0.5F), radiance);
    builder.scene.materials[material].emission.texture = 0;
    builder.add(quad_mesh({-0.5F, -0.5F, 1}, {0, 1, 0}, {1, 0, 0}, 3), material);
    return std::move(builder.scene);
}

/// Irradiance of a point of the floor by it.
inline glm::dvec3 half_bright_irradiance(const glm::dvec3& point) {
    const Mesh bright = quad_mesh({-0.5F, 0, 1}, {0, 0.5F, 0}, {1, 0, 0});
    return polygon_irradiance(corners_of(bright), point, {0, 0, 1}) * glm::dvec3(radiance) *
           glm::dvec3(0.2, 1.0, 1.0);
}

}  // namespace weft::test

#endif
