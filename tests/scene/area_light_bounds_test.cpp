// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/area_light_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/testing/scene_builder.h"

namespace weft::area_light_bounds_test {
namespace {

/// A scene of this area light alone.
FlatScene lit_by(const Mesh& area_light) {
    test::SceneBuilder builder;
    builder.add(area_light, builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    return flatten(builder.scene);
}

bool is_panel(const Mesh& area_light) {
    const shared::float4 axis = lit_by(area_light).lights.at(0).axis;
    return axis.x != 0.0F || axis.y != 0.0F || axis.z != 0.0F;
}

Mesh joined(Mesh a, const Mesh& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    a.uvs.insert(a.uvs.end(), b.uvs.begin(), b.uvs.end());
    for (const auto& [i, j, k] : b.triangles)
        a.triangles.push_back({first + i, first + j, first + k});
    return a;
}

const Mesh panel = test::quad_mesh({0, 0, 0}, {2, 0, 0}, {0, 1, 1});

TEST(AreaLightBounds, APanelHasANormalAndABall) {
    const FlatScene flat = lit_by(panel);
    const shared::LightRecord light = flat.lights.at(0);
    EXPECT_NEAR(light.axis.x, 0.0F, 1e-6F);
    EXPECT_NEAR(std::abs(light.axis.y), std::sqrt(0.5F), 1e-6F);
    EXPECT_NEAR(light.axis.y, -light.axis.z, 1e-6F);
    // The furthest corner is on the ball, and no other outside; up to a rounding.
    const glm::vec3 centre(light.position.x, light.position.y, light.position.z);
    float furthest = 0.0F;
    for (const shared::float4& corner : flat.positions)
        furthest =
            std::max(furthest, glm::length(glm::vec3(corner.x, corner.y, corner.z) - centre));
    EXPECT_NEAR(light.position.w, furthest, 1e-6F * furthest);
}

TEST(AreaLightBounds, OnlyOneFlatPanelIsAPanel) {
    EXPECT_TRUE(is_panel(panel));
    // Apart in the same plane, and then with what joins the two.
    const Mesh beside = test::quad_mesh({4, 0, 0}, {2, 0, 0}, {0, 1, 1});
    EXPECT_FALSE(is_panel(joined(panel, beside)));
    EXPECT_TRUE(
        is_panel(joined(joined(panel, beside), test::quad_mesh({2, 0, 0}, {2, 0, 0}, {0, 1, 1}))));
    // A bend, a box, and too many triangles.
    EXPECT_FALSE(is_panel(joined(panel, test::quad_mesh({2, 0, 0}, {2, 0, 1}, {0, 1, 1}))));
    EXPECT_FALSE(is_panel(test::room_mesh()));
    EXPECT_TRUE(is_panel(test::quad_mesh({0, 0, 0}, {2, 0, 0}, {0, 1, 1}, 2)));
    EXPECT_FALSE(is_panel(test::quad_mesh({0, 0, 0}, {2, 0, 0}, {0, 1, 1}, 3)));
}

}  // namespace
}  // namespace weft::area_light_bounds_test
