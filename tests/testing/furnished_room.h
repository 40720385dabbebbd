// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_FURNISHED_ROOM_H
#define WEFT_TESTS_TESTING_FURNISHED_ROOM_H

#include <cstdint>
#include <utility>

#include "tests/testing/bvh_meshes.h"
#include "tests/testing/scene_builder.h"

namespace weft::test {

/// Adds what surfaces and lights can have to a room [-1, 1]^3 without walls: a textured floor, a
/// ball with smooth normals, a screen that emits by a texture, a point light, a spot light and
/// light from all around.
inline void furnish(SceneBuilder& builder) {
    Texture texture;
    texture.width = texture.height = 4;
    Uniform uniform(3);
    for (int i = 0; i < 4 * 16; ++i)
        texture.rgba.push_back(static_cast<std::uint8_t>(uniform(40.0F, 250.0F)));
    builder.scene.textures.push_back(texture);
    const std::uint32_t textured = builder.material({0.9F, 0.8F, 0.7F});
    set_albedo_texture(builder.scene.materials[textured], 0);
    builder.add(quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}, 3), textured);
    Mesh ball = icosphere(2, false);
    ball.normals = ball.positions;
    builder.add(std::move(ball), builder.material({0.8F, 0.9F, 0.6F}),
                placement(0.35, {-0.4, -0.64, -0.2}));
    const std::uint32_t screen = builder.material({0.0F, 0.0F, 0.0F}, {0.5F, 1.0F, 2.0F});
    builder.scene.materials[screen].emission.texture = 0;
    builder.add(quad_mesh({-0.9F, 0.1F, -0.8F}, {0.2F, 0, 0.2F}, {0, 0.3F, 0}), screen);
    builder.light(LightType::point, {0.5, 0.4, 0.6}, {0.3F, 0.4F, 0.3F});
    builder.light(LightType::spot, {0.0, 0.9, 0.8}, {2.0F, 1.5F, 1.0F}, {0.1, -1.0, -0.6})
        .cos_outer = 0.8F;
    builder.scene.environment = Environment{{0.2F, 0.3F, 0.4F}};
}

}  // namespace weft::test

#endif
