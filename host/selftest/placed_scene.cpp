// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/placed_scene.h"

#include <cstdint>
#include <utility>

#include "selftest/scene_builder.h"

namespace weft::selftest {

Placed placed_scene(double scale, const glm::dvec3& move) {
    SceneBuilder builder;
    const glm::dmat4 root = placement(scale, move);
    const std::uint32_t white = builder.material({0.7F, 0.6F, 0.5F});
    builder.add(quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}, 4), white, root);
    builder.add(quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 4), white, root);
    builder.add(quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}, 4),
                builder.material({0.2F, 0.6F, 0.2F}), root);
    Mesh ball = icosphere(3, false);
    ball.normals = ball.positions;
    builder.add(std::move(ball), builder.material({0.8F, 0.8F, 0.9F}),
                root * placement(0.4, {0.3, -0.5, 0.2}));
    builder.add(quad_mesh({-0.4F, 0.9F, -0.4F}, {0.8F, 0, 0}, {0, 0, 0.8F}),
                builder.material(glm::vec3(0.3F), {4.0F, 5.0F, 6.0F}), root);
    const auto at = [&](const glm::dvec3& p) { return glm::dvec3(root * glm::dvec4(p, 1.0)); };
    const auto square = static_cast<float>(scale * scale);
    builder.light(LightType::point, at({0.7, 0.6, 0.6}), glm::vec3(0.3F) * square);
    PunctualLight& spot = builder.light(LightType::spot, at({-0.5, 0.8, 0.8}),
                                        glm::vec3(1.0F) * square, {0.3, -1.0, -0.7});
    spot.cos_inner = 0.95F;
    spot.cos_outer = 0.85F;
    builder.light(LightType::directional, {}, glm::vec3(0.4F), {-0.5, -1.0, -0.4});
    Camera camera = look_at({0.4, 0.3, 2.6}, {0.0, -0.1, 0.0}, 0.8);
    camera.to_world = root * camera.to_world;
    return {builder.scene, camera};
}

std::size_t isolated_dark_pixels(const Rendering& reference, const Rendering& test) {
    const auto ratio = [&](std::uint32_t x, std::uint32_t y) {
        const float base = reference.at("", x, y, 1);
        return base > 0.0F ? test.at("", x, y, 1) / base : 1.0F;
    };
    std::size_t count = 0;
    for (std::uint32_t y = 1; y + 1 < test.image.height; ++y)
        for (std::uint32_t x = 1; x + 1 < test.image.width; ++x) {
            if (ratio(x, y) >= 0.5F) continue;
            bool alone = true;
            for (std::uint32_t i = 0; i < 9; ++i)
                if (i != 4) alone = alone && ratio(x + i % 3 - 1, y + i / 3 - 1) > 0.8F;
            count += alone ? 1 : 0;
        }
    return count;
}

}  // namespace weft::selftest
