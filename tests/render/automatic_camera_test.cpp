// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/automatic_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "scene/field_of_view.h"
#include "scene/moving_scene.h"
#include "tests/testing/media_builder.h"
#include "tests/testing/scene_builder.h"

namespace weft::automatic_camera_test {
namespace {

Camera camera_for(const Scene& scene) {
    return automatic_camera(flatten(scene), bounds_of(scene));
}

Scene scene_of(const Mesh& mesh, const glm::dmat4& to_world = glm::dmat4(1.0)) {
    test::SceneBuilder builder;
    builder.add(mesh, builder.material({0.5F, 0.5F, 0.5F}), to_world);
    return builder.scene;
}

glm::dvec3 towards_camera(const Camera& camera) {
    return glm::normalize(glm::dvec3(camera.to_world[2]));
}

/// Largest distance of the scene's vertices from the middle of a square image, whose edge has 1.
double widest(const Camera& camera, const Scene& scene) {
    const double tangent = vertical_tangent(camera, 1.0);
    const glm::dmat4 to_camera = glm::inverse(camera.to_world);
    double most = 0.0;
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& position : scene.meshes[instance.mesh].positions) {
            const glm::dvec3 p(to_camera * instance.to_world *
                               glm::dvec4(glm::dvec3(position), 1.0));
            EXPECT_LT(p.z, 0.0) << "behind the camera";
            most = std::max(most, std::max(std::abs(p.x), std::abs(p.y)) / (-p.z * tangent));
        }
    return most;
}

TEST(AutomaticCamera, ShowsAPlainThingFromTheFrontAndAbove) {
    const Scene scene = scene_of(test::cube_mesh());
    const Camera camera = camera_for(scene);
    EXPECT_NEAR(glm::dot(towards_camera(camera), glm::normalize(glm::dvec3(0.5, 0.35, 1.0))), 1.0,
                1e-9);
    EXPECT_GT(camera.to_world[1].y, 0.5) << "+y is up";
    EXPECT_LT(widest(camera, scene), 1.0);
    EXPECT_GT(widest(camera, scene), 0.85);
}

TEST(AutomaticCamera, FacesAFlatThingFromItsFront) {
    const Mesh picture = test::quad_mesh({-1, -0.5F, 0}, {2, 0, 0}, {0, 1, 0});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 40; ++i) {
        // The first ones lie along axes: a wall to each side, a floor and a ceiling.
        glm::dmat4 turn(1.0);
        if (i < 4)
            turn = glm::rotate(turn, 1.5707963267948966 * i, glm::dvec3(0, 1, 0));
        else if (i < 6)
            turn = glm::rotate(turn, i == 4 ? 1.5707963267948966 : -1.5707963267948966,
                               glm::dvec3(1, 0, 0));
        else
            turn = glm::rotate(turn, 3.0 * any(random),
                               glm::dvec3(any(random), any(random), any(random)));
        const glm::dmat4 to_world =
            glm::translate(glm::dmat4(1.0), glm::dvec3(3.0, -2.0, 9.0)) * turn;
        const Scene scene = scene_of(picture, to_world);
        const Camera camera = camera_for(scene);
        EXPECT_GT(glm::dot(towards_camera(camera), glm::dvec3(turn[2])), 0.999) << i;
        EXPECT_LE(widest(camera, scene), 1.0) << i;
        EXPECT_GT(widest(camera, scene), 0.5) << i;
        EXPECT_NEAR(glm::determinant(glm::dmat3(camera.to_world)), 1.0, 1e-9) << i;
    }
}

TEST(AutomaticCamera, SeesTerrainFromAboveAtAnAngle) {
    for (const float height : {0.02F, 0.06F, 0.1F}) {
        Mesh terrain = test::quad_mesh({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, 40);
        for (glm::vec3& p : terrain.positions)
            p.y = 10.0F * height * std::sin(1.7F * p.x) * std::cos(1.3F * p.z);
        for (const bool turned : {false, true}) {
            // Faces that look down make no difference to what is up where both are there.
            if (turned) {
                const auto triangles = terrain.triangles;
                for (const auto& [a, b, c] : triangles) terrain.triangles.push_back({a, c, b});
            }
            const Scene scene = scene_of(terrain);
            const Camera camera = camera_for(scene);
            const double elevation = std::asin(towards_camera(camera).y);
            EXPECT_GT(elevation, 0.6) << height;
            EXPECT_LT(elevation, 1.45) << height;
            EXPECT_GT(towards_camera(camera).z, 0.0) << "from the front";
            EXPECT_LE(widest(camera, scene), 1.0);
        }
    }
}

TEST(AutomaticCamera, SeesALongThingFromItsSide) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 size(1.0);
        size[axis] = 12.0;
        const Scene scene = scene_of(test::cube_mesh(), glm::scale(glm::dmat4(1.0), size));
        const Camera camera = camera_for(scene);
        EXPECT_LT(std::abs(towards_camera(camera)[axis]), 0.6) << axis;
        EXPECT_LE(widest(camera, scene), 1.0) << axis;
    }
}

TEST(AutomaticCamera, PointsLinesAndNothingHaveACameraToo) {
    Mesh line;
    line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    line.triangles = {{0, 1, 2}};
    Mesh point;
    point.positions = {{5, 5, 5}, {5, 5, 5}, {5, 5, 5}};
    point.triangles = {{0, 1, 2}};
    Scene empty;
    for (const Scene& scene : {scene_of(line), scene_of(point), empty}) {
        const Camera camera = camera_for(scene);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) EXPECT_TRUE(std::isfinite(camera.to_world[c][r]));
        EXPECT_NEAR(glm::determinant(glm::dmat3(camera.to_world)), 1.0, 1e-9);
        EXPECT_LE(widest(camera, scene), 1.0);
    }
}

TEST(AutomaticCamera, ShowsAllThatIsThereInAnyFrame) {
    // A cube that travels along x from 0 to 20 within ten frames, beside a still one.
    test::SceneBuilder builder;
    const std::uint32_t material = builder.material({0.5F, 0.5F, 0.5F});
    builder.add(test::cube_mesh(), material);
    builder.add(test::cube_mesh(), material);
    Scene scene = builder.scene;
    scene.instances[1].may_move = true;
    ObjectMove move;
    move.by = {20.0, 0.0, 0.0};
    MovingScene moving(scene, EditTimeline{{SceneEdit{"edits.json", 0, 10, {1}, move}}}, 30.0);
    EXPECT_LT(moving.bounds(0, 1).high.x, 5.0) << "a tenth of the way, or less";
    EXPECT_EQ(moving.bounds(0, 11).high, glm::dvec3(21.0, 1.0, 1.0));
    EXPECT_EQ(moving.bounds(0, 1000000).high, glm::dvec3(21.0, 1.0, 1.0));
    EXPECT_EQ(moving.bounds(10, 11).low, glm::dvec3(-1.0)) << "of the still one";
    EXPECT_EQ(MovingScene(scene, {}, 30.0).bounds(0, 10).high, glm::dvec3(1.0));
    const Camera camera = automatic_camera(moving.flat(), moving.bounds(0, 11));
    EXPECT_LE(widest(camera, scene), 1.0);
    scene.instances[1].to_world = test::placement(1.0, {20.0, 0.0, 0.0});
    EXPECT_LE(widest(camera, scene), 1.0);
    EXPECT_GT(widest(camera, scene), 0.7);
    scene.instances[1].present = false;
    EXPECT_EQ(bounds_of(scene).high, glm::dvec3(1.0));
}

}  // namespace
}  // namespace weft::automatic_camera_test
