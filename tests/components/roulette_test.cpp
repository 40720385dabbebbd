// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/testing/render_fixture.h"
#include "tests/testing/room_scenes.h"

// Roulette among VPLs that would add little: it must cost no light on average, and save rays.
namespace weft::roulette_test {
namespace {

using test::Rendering;
using test::TestBackend;

/// A room with a coloured wall, a block and an area light.
Scene room() {
    test::SceneBuilder builder;
    test::add_open_room(builder);
    test::add_screen(builder);
    builder.add(test::quad_mesh({-0.3F, 0.98F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material({0.2F, 0.2F, 0.2F}, {8.0F, 7.0F, 5.0F}));
    return builder.scene;
}

/// Frame 0 with every pixel sampled, so that roulette alone makes a difference.
/// Blocks of receivers decide where VPLs are chosen among `candidates`, else each receiver does.
Rendering make_image(const Scene& scene, double roulette, std::uint32_t candidates,
                     std::uint32_t seed) {
    RenderSettings settings = test::small_settings(Algorithm::ais, 24, 24);
    settings.direct = false;
    settings.seed = seed;
    settings.sampling.threshold = 1e-30;
    settings.sampling.enough_support = 2.0;
    settings.sampling.edge_samples = 0;
    settings.sampling.roulette = roulette;
    settings.sampling.candidates = candidates;
    return test::render(TestBackend::own_bvh, scene, test::look_at({0, 0, 3.5}, {0, 0, 0}, 0.6),
                        settings);
}

double mean_indirect(const Rendering& rendering) {
    double sum = 0.0;
    for (std::uint32_t y = 0; y < 24; ++y)
        for (std::uint32_t x = 0; x < 24; ++x)
            sum += static_cast<double>(rendering.at("indirect", x, y));
    return sum / (24.0 * 24.0);
}

std::uint64_t rays_of(const Rendering& rendering) {
    std::uint64_t rays = 0;
    for (const StageStats& stage : rendering.stats.front().stages)
        if (stage.stage == Stage::vpl_gather) rays += stage.rays;
    return rays;
}

/// Relative difference of the mean of images with and without roulette: over `seeds` pairs that
/// share their VPLs, with its standard error.
void expect_no_loss(double roulette, double share_of_rays, std::uint32_t candidates,
                    std::uint32_t seeds) {
    const Scene scene = room();
    double sum = 0.0;
    double squares = 0.0;
    std::uint64_t with_rays = 0;
    std::uint64_t without_rays = 0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        const Rendering with = make_image(scene, roulette, candidates, seed);
        const Rendering without = make_image(scene, 0.0, candidates, seed);
        const double d = mean_indirect(with) / mean_indirect(without) - 1.0;
        sum += d;
        squares += d * d;
        with_rays += rays_of(with);
        without_rays += rays_of(without);
    }
    const double mean = sum / seeds;
    const double error = std::sqrt((squares / seeds - mean * mean) / (seeds - 1));
    // Four standard errors: 99.99 %.
    EXPECT_LT(std::abs(mean), 4.0 * error) << roulette;
    EXPECT_LT(error, 0.002) << "too few images to notice a loss";
    EXPECT_LT(static_cast<double>(with_rays), share_of_rays * static_cast<double>(without_rays));
}

TEST(Roulette, CostsNoLightAndSavesRays) {
    expect_no_loss(0.5, 0.96, 1, 192);
    expect_no_loss(2.0, 0.8, 1, 192);
    expect_no_loss(0.5, 0.98, 8, 448);
    expect_no_loss(2.0, 0.8, 8, 448);
}

TEST(Roulette, AllBackendsDrawTheSame) {
    const Scene scene = room();
    RenderSettings settings = test::small_settings(Algorithm::ais, 40, 40);
    settings.sampling.roulette = 1.0;
    const Camera camera = test::look_at({0, 0, 3.5}, {0, 0, 0}, 0.6);
    for (const std::uint32_t candidates : {1U, 8U}) {
        settings.sampling.candidates = candidates;
        const Rendering expected = test::render(TestBackend::own_bvh, scene, camera, settings);
        for (const TestBackend backend : test::backends()) {
            if (backend == TestBackend::embree) continue;
            EXPECT_EQ(test::differing_values(test::render(backend, scene, camera, settings).image,
                                             expected.image),
                      0U)
                << test::backend_name(backend);
        }
    }
}

}  // namespace
}  // namespace weft::roulette_test
