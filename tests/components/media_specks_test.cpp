// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "tests/testing/media_builder.h"
#include "tests/testing/render_fixture.h"

// View rays that pass virtual lights at touching distance: what a medium scatters there of one of
// them must not show as a speck. A narrow spot puts all virtual lights of one bounce on a
// disk of 1/100 of the room's edge, and all rays of a narrow view end in its middle.
namespace weft::media_specks_test {
namespace {

using test::SceneBuilder;

constexpr std::uint32_t edge = 12;
const glm::dvec3 eye(0.1, 0.05, 0.9);
const glm::dvec3 lit_place(0.2, -0.1, -1.0);

SceneBuilder hazy_room() {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.7F)));
    builder.scene.media.push_back(test::medium_of(glm::vec3(0.05F), glm::vec3(1.0F)));
    builder.scene.outer_medium = 0;
    PunctualLight spot;
    spot.type = LightType::spot;
    spot.intensity = glm::vec3(100.0F);
    spot.position = lit_place + glm::dvec3(0.02, 0.03, 0.15);
    spot.direction = glm::normalize(lit_place - spot.position);
    spot.cos_inner = 1.0F;
    spot.cos_outer = std::cos(0.06F);
    builder.scene.lights.push_back(spot);
    return builder;
}

/// Mean of the scattered light of an image, with light after that many bounces.
double scattered(Executor& executor, const FlatScene& flat, std::uint32_t seed,
                 std::uint32_t bounces) {
    RenderSettings settings = test::small_settings(Algorithm::igi, edge, edge);
    settings.direct = false;
    settings.sampling.bounces = bounces;
    settings.sampling.vpls_per_set = 16;
    settings.seed = seed;
    const Camera camera = test::look_at(eye, lit_place, 0.002);
    return test::mean_of(test::render_flat(executor, flat, camera, settings).layer("media"));
}

TEST(MediaSpecks, ManyLightsAtTouchingDistanceAddUpToTheSameEachTime) {
    const FlatScene flat = flatten(hazy_room().scene);
    for (const test::TestBackend backend : test::backends()) {
        constexpr int seeds = 16;
        double sum = 0.0;
        double squares = 0.0;
        for (std::uint32_t seed = 0; seed < seeds; ++seed) {
            Executor& executor = test::shared_executor(backend);
            // What the spot itself lights is the same in both.
            const double light =
                scattered(executor, flat, seed, 1) - scattered(executor, flat, seed, 0);
            sum += light;
            squares += light * light;
        }
        const double mean = sum / seeds;
        const double deviation = std::sqrt((squares - sum * mean) / (seeds - 1));
        EXPECT_GT(mean, 0.0) << test::backend_name(backend);
        // Measured 0.03; with places spread over angles alone 0.58.
        EXPECT_LT(deviation, 0.1 * mean) << test::backend_name(backend);
    }
}

}  // namespace
}  // namespace weft::media_specks_test
