// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "tests/testing/smoky_room.h"

// Path tracing through density grids: the same bits however it is done, and grids that hold
// nothing or anything.
namespace weft::path_smoke_test {
namespace {

using test::add_grid;
using test::foggy_room;
using test::medium_of;
using test::room_camera;
using test::room_eye;
using test::smoky_room;
using test::TestBackend;

TEST(PathSmoke, SameBitsOnDevicesAndInParts) {
    const FlatScene flat = flatten(smoky_room());
    Executor& own = test::shared_executor(TestBackend::own_bvh);
    const FilmSums whole =
        test::path_sums(own, flat, room_camera(), test::path_settings(24, 16, 8));
    PathSettings half = test::path_settings(24, 16, 8);
    half.samples = {0, 3};
    const FilmSums first = test::path_sums(own, flat, room_camera(), half);
    half.samples = {3, 8};
    EXPECT_EQ(test::path_sums(own, flat, room_camera(), half, first).words, whole.words);
    const auto single = test::make_executor(TestBackend::own_bvh, 0, 1);
    EXPECT_EQ(test::path_sums(*single, flat, room_camera(), test::path_settings(24, 16, 8)).words,
              whole.words);
    if (!test::has_opencl()) GTEST_SKIP() << "no OpenCL device";
    EXPECT_EQ(test::path_sums(test::shared_executor(TestBackend::opencl), flat, room_camera(),
                              test::path_settings(24, 16, 8))
                  .words,
              whole.words);
}

TEST(PathSmoke, EmptyGridsAreClearAir) {
    Scene scene = smoky_room();
    scene.media.pop_back();
    scene.medium_boundaries.clear();
    for (float& density : scene.grids[0].densities) density = 0.0F;
    const FlatScene empty = flatten(scene);
    EXPECT_FALSE(empty.media.present());
    EXPECT_TRUE(empty.media.grids.densities.empty());
    scene.media.clear();
    scene.grids.clear();
    scene.outer_medium = -1;
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const PathSettings settings = test::path_settings(16, 16, 4);
    EXPECT_EQ(test::path_sums(executor, empty, room_camera(), settings).words,
              test::path_sums(executor, flatten(scene), room_camera(), settings).words);
}

TEST(PathSmoke, HostileGridsStayFinite) {
    // Densities of all magnitudes, enormous and tiny extinction, grids that are flat or far away,
    // the light inside, no light. path_sums expects every value to be finite.
    const std::vector<double> values = {0.0, 3e38, 1e-45, 1.0, 1e30};
    for (const float sigma : {1e-30F, 1.0F, 1e30F})
        for (const glm::dvec3& size :
             {glm::dvec3(1.0), glm::dvec3(1.0, 1e-30, 1.0), glm::dvec3(1e12)}) {
            Scene scene = foggy_room().scene;
            scene.media[0] = medium_of({sigma, 1.0F, 0.0F}, glm::vec3(0.9F), 0.9999F);
            add_grid(scene, 0,
                     make_grid({9, 5, 7},
                               [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
                                   return values[(i + j + k) % values.size()];
                               }),
                     glm::scale(glm::dmat4(1.0), size));
            scene.outer_medium = 0;
            scene.lights[0].position = {0.0, 0.0, 0.0};
            for (const glm::dvec3& from : {room_eye, glm::dvec3(0.0, 0.0, 1.0)})
                (void)test::path_image(TestBackend::own_bvh, scene,
                                       test::look_at(from, {0.0, 0.0, 0.0}, 1.0),
                                       test::path_settings(9, 9, 8));
            scene.instances.clear();
            scene.lights.clear();
            (void)test::path_image(TestBackend::own_bvh, scene,
                                   test::look_at({0, 0, 1}, {0, 0, 0}, 1.0),
                                   test::path_settings(9, 9, 8));
        }
}

}  // namespace
}  // namespace weft::path_smoke_test
