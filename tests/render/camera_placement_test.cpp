// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/camera_placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "base/error.h"

namespace weft::camera_placement_test {
namespace {

Camera some_camera() {
    Camera camera;
    camera.name = "own";
    camera.fov = 0.6;
    camera.mirror_x = true;
    camera.motion.node = 3;
    return camera;
}

glm::dvec3 column(const Camera& camera, int i) {
    return {camera.to_world[i].x, camera.to_world[i].y, camera.to_world[i].z};
}

TEST(CameraPlacement, PointsWhereItIsTold) {
    const CameraView view{{3.0, -2.0, 7.0}, {1.0, 4.0, -5.0}, {0.3, 0.0, 9.0}};
    ASSERT_TRUE(can_point(view));
    const Camera placed = placed_camera(some_camera(), {view, {}});
    EXPECT_EQ(column(placed, 3), view.from);
    // Cameras look along their -z axis.
    EXPECT_LT(glm::length(column(placed, 2) + glm::normalize(view.at - view.from)), 1e-14);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k <= i; ++k)
            EXPECT_NEAR(glm::dot(column(placed, i), column(placed, k)), i == k ? 1.0 : 0.0, 1e-14);
    EXPECT_LT(glm::length(glm::cross(column(placed, 0), column(placed, 1)) - column(placed, 2)),
              1e-14);
    // Upwards in the image is as near to `up` as the view allows.
    EXPECT_NEAR(glm::dot(column(placed, 0), view.up), 0.0, 1e-13);
    EXPECT_GT(glm::dot(column(placed, 1), view.up), 0.0);
    EXPECT_EQ(placed.fov, 0.6);
    EXPECT_FALSE(placed.mirror_x);
    EXPECT_FALSE(placed.motion.moves());
}

TEST(CameraPlacement, PlacesAtAnySize) {
    for (const double size : {1e-200, 1e-12, 1.0, 1e15}) {
        const CameraView view{{0.0, 0.0, size}, {0.0, 0.0, -size}, {0.0, size * 1e-3, 0.0}};
        ASSERT_TRUE(can_point(view)) << size;
        const Camera placed = placed_camera(some_camera(), {view, {}});
        EXPECT_LT(glm::length(column(placed, 0) - glm::dvec3(1, 0, 0)), 1e-14) << size;
        EXPECT_LT(glm::length(column(placed, 1) - glm::dvec3(0, 1, 0)), 1e-14) << size;
    }
}

TEST(CameraPlacement, TellsWhereNoCameraCanPoint) {
    EXPECT_FALSE(can_point({{1, 2, 3}, {1, 2, 3}, {0, 1, 0}}));
    EXPECT_FALSE(can_point({{0, 5, 0}, {0, 1, 0}, {0, 1, 0}}));
    EXPECT_FALSE(can_point({{0, 5, 0}, {0, 9, 0}, {0, 1, 0}}));
    EXPECT_FALSE(can_point({{0, 0, 5}, {0, 0, 0}, {0, 0, 0}}));
    EXPECT_FALSE(can_point({{0, 0, std::numeric_limits<double>::infinity()}, {}, {0, 1, 0}}));
    EXPECT_TRUE(can_point({{0, 5, 0}, {0, 1, 0}, {0, 0, -1}}));
}

TEST(CameraPlacement, FieldsOfViewAreThoseOfPerspective) {
    const Camera wide = placed_camera(some_camera(), {{}, 90.0});
    EXPECT_DOUBLE_EQ(wide.fov, 0.5 * std::numbers::pi);
    EXPECT_TRUE(wide.motion.moves());
    EXPECT_TRUE(wide.mirror_x);
    Camera flat = some_camera();
    flat.half_extent = {1.0, 1.0};
    try {
        (void)placed_camera(flat, {{}, 90.0});
        FAIL() << "an orthographic camera got a field of view";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_STREQ(error.what(),
                     "--fov: camera 'own' is orthographic, expected one with perspective");
    }
    EXPECT_EQ(placed_camera(flat, {CameraView{{0, 0, 1}, {}, {0, 1, 0}}, {}}).half_extent.x, 1.0);
}

}  // namespace
}  // namespace weft::camera_placement_test
