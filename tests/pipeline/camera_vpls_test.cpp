// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/camera_vpls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "tests/testing/render_fixture.h"
#include "tests/testing/room_scenes.h"

// VPLs that are chosen for the camera, against all that light paths leave: the same light on
// average, and less noise.
namespace weft::camera_vpls_test {
namespace {

using test::Rendering;
using test::TestBackend;

/// A room of which the camera sees what stands before a screen; the lamp hangs behind it.
Scene room() {
    test::SceneBuilder builder;
    test::add_open_room(builder);
    test::add_screen(builder);
    builder.add(test::quad_mesh({-0.3F, 0.98F, -0.9F}, {0.6F, 0, 0}, {0, 0, 0.4F}),
                builder.material({0.2F, 0.2F, 0.2F}, {8.0F, 7.0F, 5.0F}));
    return builder.scene;
}

/// Every pixel gathers all VPLs of its set, with the same bound, so that the choice alone differs.
RenderSettings settings_of(const FlatScene& flat, std::uint32_t candidates, std::uint32_t seed) {
    RenderSettings settings = test::small_settings(Algorithm::amax, 24, 24);
    settings.direct = false;
    settings.seed = seed;
    settings.sampling.vpls_per_set = 24;
    settings.sampling.local_bounds = false;
    settings.sampling.vpl_tail = false;
    settings.sampling.edge_samples = 0;
    settings.sampling.candidates = candidates;
    settings.sampling.bound_spacing = std::sqrt(plan_for(flat, settings).vpls_per_set / 24.0);
    return settings;
}

struct Sums {
    double mean = 0.0, squares = 0.0;

    void add(double value) {
        mean += value;
        squares += value * value;
    }
    [[nodiscard]] double variance(double count) const {
        return squares / count - (mean / count) * (mean / count);
    }
};

TEST(CameraVpls, KeepTheLightAndHaveLessNoise) {
    constexpr std::uint32_t seeds = 256;
    const FlatScene flat = flatten(room());
    const Camera camera = test::look_at({0, 0, 3.5}, {0, 0, 0}, 0.6);
    Sums all;
    Sums chosen;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        // Different seeds, so that both are independent.
        all.add(test::mean_of(test::render_flat(test::shared_executor(TestBackend::own_bvh), flat,
                                                camera, settings_of(flat, 1, seed))
                                  .layer("indirect")));
        chosen.add(test::mean_of(test::render_flat(test::shared_executor(TestBackend::own_bvh),
                                                   flat, camera, settings_of(flat, 8, 1000 + seed))
                                     .layer("indirect")));
    }
    const double error = std::sqrt((all.variance(seeds) + chosen.variance(seeds)) / seeds);
    // Four standard errors: 99.99 %.
    EXPECT_LT(std::abs(all.mean - chosen.mean) / seeds, 4.0 * error);
    EXPECT_LT(error, 0.015 * all.mean / seeds) << "too few images to notice a loss";
    EXPECT_LT(chosen.variance(seeds), 0.5 * all.variance(seeds));
}

TEST(CameraVpls, AnyImageAndAnyMotionHasThem) {
    // One pixel, one row, an image of the background alone, and a camera that moves.
    const FlatScene flat = flatten(room());
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    for (const auto& [width, height] :
         {std::pair{1U, 1U}, std::pair{37U, 1U}, std::pair{2U, 50U}, std::pair{200U, 190U}}) {
        RenderSettings settings = settings_of(flat, 8, 1);
        settings.width = width;
        settings.height = height;
        test::expect_clean(test::render_flat(
            executor, flat, test::look_at({0, 0, 3.5}, {0, 0, 0}, 0.6), settings, 2));
        test::expect_clean(test::render_flat(executor, flat,
                                             test::look_at({0, 0, 3.5}, {0, 0, 9}, 0.6), settings));
    }
    const RenderSettings settings = settings_of(flat, 8, 1);
    Renderer renderer(executor, flat, test::look_at({0, 0, 3.5}, {0, 0, 0}, 0.6), settings);
    renderer.render_frame({});
    renderer.set_camera(test::look_at({0.4, 0.1, 3.0}, {0, 0, 0}, 0.6));
    renderer.render_frame({});
    const Rendering again =
        test::render_flat(executor, flat, test::look_at({0.4, 0.1, 3.0}, {0, 0, 0}, 0.6), settings);
    EXPECT_EQ(test::differing_values(renderer.image(), again.image), 0U)
        << "a camera that has moved sees what it would have seen from the beginning";
}

}  // namespace
}  // namespace weft::camera_vpls_test
