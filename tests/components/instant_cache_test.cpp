// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/testing/render_fixture.h"

namespace weft::instant_cache_test {
namespace {

using test::Rendering;
using test::TestBackend;

/// A box with an open front, a ball and a block in it, lit from above.
Scene furnished_box() {
    test::SceneBuilder builder;
    const std::uint32_t white = builder.material({0.7F, 0.7F, 0.7F});
    const std::uint32_t red = builder.material({0.7F, 0.1F, 0.1F});
    const std::uint32_t area_light = builder.material({0.0F, 0.0F, 0.0F}, {9.0F, 9.0F, 9.0F});
    builder.add(test::quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}), white);
    builder.add(test::quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), white);
    builder.add(test::quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}), red);
    builder.add(test::quad_mesh({1, -1, -1}, {0, 0, 2}, {0, 2, 0}), white);
    builder.add(test::quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), white);
    builder.add(test::quad_mesh({-0.3F, 0.99F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}), area_light);
    Mesh ball = test::icosphere(4, false);
    ball.normals = ball.positions;
    builder.add(std::move(ball), white, test::placement(0.35, {-0.4, -0.65, 0.1}));
    builder.add(test::quad_mesh({0.1F, -1, 0.2F}, {0.6F, 0, -0.2F}, {0, 0.8F, 0}), white);
    return builder.scene;
}

Camera front_camera() {
    return test::look_at({0.0, 0.0, 3.4}, {0.0, 0.0, 0.0}, 0.75);
}

/// All VPLs are traced, so that records and pixels of `ir` gather the same.
RenderSettings settings_of(Algorithm algorithm, std::uint32_t width, std::uint32_t height) {
    RenderSettings settings = test::small_settings(algorithm, width, height);
    settings.sampling.roulette = 0.0;
    settings.direct = false;
    return settings;
}

TEST(InstantCache, ApproachesTheGatheringOfAllVplsByEveryPixel) {
    // The brute-force reference is `ir`. The interpolation's error falls with what is allowed, its
    // mean stays within that, and with 0 every pixel is a record: all but rounding is then the
    // same.
    const Scene scene = furnished_box();
    for (const TestBackend backend : test::light_backends()) {
        SCOPED_TRACE(test::backend_name(backend));
        const Rendering all =
            test::render(backend, scene, front_camera(), settings_of(Algorithm::ir, 160, 120));
        double before = 1e9;
        for (const double error : {0.4, 0.1, 0.025, 0.0}) {
            SCOPED_TRACE("error " + std::to_string(error));
            RenderSettings settings = settings_of(Algorithm::ic, 160, 120);
            settings.sampling.cache_error = error;
            const Rendering cached = test::render(backend, scene, front_camera(), settings);
            test::expect_clean(cached);
            const double mse = test::relative_mse(all.layer("indirect"), cached.layer("indirect"));
            EXPECT_LT(mse, before);
            before = mse;
            EXPECT_NEAR(
                test::mean_of(cached.layer("indirect")) / test::mean_of(all.layer("indirect")), 1.0,
                error + 1e-5);
            if (error > 0.0) {
                EXPECT_LT(cached.stats.back().rays, all.stats.back().rays);
            }
        }
        EXPECT_LT(before, 1e-9);
    }
}

TEST(InstantCache, AdaptiveSamplingMayTakeIndirectLightFromIt) {
    // Indirect light is then that of `ic`, bit for bit; edges are left as they are, and direct
    // light stays adaptive.
    const Scene scene = furnished_box();
    for (const TestBackend backend : test::light_backends()) {
        RenderSettings alone = settings_of(Algorithm::ic, 97, 70);
        RenderSettings source = settings_of(Algorithm::ais, 97, 70);
        source.sampling.cached = true;
        source.sampling.edge_samples = 0;
        alone.direct = source.direct = true;
        const Rendering a = test::render(backend, scene, front_camera(), alone);
        const Rendering b = test::render(backend, scene, front_camera(), source);
        EXPECT_EQ(a.layer("indirect"), b.layer("indirect")) << test::backend_name(backend);
        ASSERT_EQ(b.stats.back().levels.size(), 1U);
        EXPECT_EQ(std::string(b.stats.back().levels.front().component), "direct");
    }
}

TEST(InstantCache, EveryPixelThatReflectsHasLight) {
    // Also from so close that a pixel is smaller than what keeps rays off their surfaces, and with
    // records that serve little more than their own pixel.
    const Scene scene = furnished_box();
    for (const double distance : {4.4, 0.1, 1e-3, 1e-5})
        for (const double error : {0.1, 1e-4}) {
            RenderSettings settings = settings_of(Algorithm::ic, 61, 45);
            settings.sampling.cache_error = error;
            const Camera camera = test::look_at({0.0, 0.2, distance - 1.0}, {0.0, 0.2, -1.0}, 0.75);
            const Rendering cached = test::render(TestBackend::own_bvh, scene, camera, settings);
            test::expect_clean(cached);
            std::size_t dark = 0;
            for (std::uint32_t y = 0; y < 45; ++y)
                for (std::uint32_t x = 0; x < 61; ++x)
                    dark +=
                        cached.at("albedo", x, y) > 0.0F && !(cached.at("indirect", x, y) > 0.0F);
            EXPECT_EQ(dark, 0U) << "distance " << distance << " error " << error;
        }
}

TEST(InstantCache, NoLightLeaksThroughAThinWall) {
    // A box open in front, parted by a wall a thousandth as thick as the box is wide; a light in
    // one half. What is lit there cannot see the other half, floor and ceiling go through.
    test::SceneBuilder builder;
    const std::uint32_t white = builder.material({0.8F, 0.8F, 0.8F});
    builder.add(test::quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}), white);
    builder.add(test::quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), white);
    builder.add(test::quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}), white);
    builder.add(test::quad_mesh({1, -1, -1}, {0, 0, 2}, {0, 2, 0}), white);
    builder.add(test::quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), white);
    for (const float x : {-0.001F, 0.001F})
        builder.add(test::quad_mesh({x, -1, -1}, {0, 2, 0}, {0, 0, 2}), white);
    builder.light(LightType::point, {-0.5, 0.0, 0.3}, glm::vec3(1.0F));
    for (const TestBackend backend : test::light_backends()) {
        SCOPED_TRACE(test::backend_name(backend));
        const Rendering cached =
            test::render(backend, builder.scene, test::look_at({0, 0, 3.4}, {0, 0, 0}, 0.75),
                         settings_of(Algorithm::ic, 256, 192));
        double bright = 0.0;
        double leaked = 0.0;
        std::size_t pixels = 0;
        for (std::uint32_t y = 0; y < 192; ++y)
            for (std::uint32_t x = 0; x < 256; ++x) {
                const auto light = static_cast<double>(cached.at("indirect", x, y));
                // The wall's own front edge is seen in the middle columns.
                if (x < 126) bright += light;
                if (x >= 130) leaked = std::max(leaked, light);
                pixels += x < 126 && light > 0.0 ? 1 : 0;
            }
        ASSERT_GT(pixels, 5000U);
        bright /= static_cast<double>(pixels);
        EXPECT_GT(bright, 0.01);
        EXPECT_LT(leaked, 1e-4 * bright);
    }
}

TEST(InstantCache, AnIntegratingSphereIsEvenlyLit) {
    // I / R^2 (rho + ... + rho^4) everywhere; see vpl_sphere_test.cpp. The error allowed is that of
    // records whose normal turns.
    constexpr double error = 0.02;
    test::SceneBuilder builder;
    builder.add(test::icosphere(5, true), builder.material({0.5F, 0.9F, 0.1F}));
    builder.light(LightType::point, {0, 0, 0}, glm::vec3(2.0F));
    for (const TestBackend backend : test::light_backends()) {
        RenderSettings settings = test::unbounded(settings_of(Algorithm::ic, 64, 48));
        settings.sampling.cache_error = error;
        settings.sampling.bounces = 4;
        settings.sampling.vpl_tail = false;
        const Rendering cached =
            test::render(backend, builder.scene,
                         test::look_at({0.1, -0.2, 0.3}, {-0.5, 0.3, -0.8}, 1.2), settings);
        test::expect_clean(cached);
        for (std::uint32_t c = 0; c < 3; ++c) {
            const double rho = c == 0 ? 0.5 : c == 1 ? 0.9 : 0.1;
            const double expected = 2.0 * (rho + rho * rho + rho * rho * rho + std::pow(rho, 4));
            double sum = 0.0;
            for (std::uint32_t y = 0; y < 48; ++y)
                for (std::uint32_t x = 0; x < 64; ++x)
                    sum += cached.irradiance("indirect", x, y, c);
            EXPECT_NEAR(sum / (64.0 * 48.0) / expected, 1.0, error) << test::backend_name(backend);
        }
    }
}

TEST(InstantCache, RouletteKeepsTheMean) {
    // 64 frames with and without: the means agree within the standard error of their difference,
    // taken from the frames' own spread; 4 standard errors are exceeded in 6 of 100,000 seeds.
    const Scene scene = furnished_box();
    RenderSettings with = settings_of(Algorithm::ic, 48, 36);
    with.sampling.roulette = 4.0;
    const RenderSettings without = settings_of(Algorithm::ic, 48, 36);
    std::vector<double> differences;
    for (std::uint32_t seed = 0; seed < 64; ++seed) {
        RenderSettings a = with;
        RenderSettings b = without;
        a.seed = b.seed = seed;
        const double mean_with = test::mean_of(
            test::render(TestBackend::own_bvh, scene, front_camera(), a).layer("indirect"));
        const double mean_without = test::mean_of(
            test::render(TestBackend::own_bvh, scene, front_camera(), b).layer("indirect"));
        differences.push_back(mean_with / mean_without - 1.0);
    }
    double mean = 0.0;
    for (const double d : differences) mean += d / 64.0;
    double variance = 0.0;
    for (const double d : differences) variance += (d - mean) * (d - mean) / 63.0;
    EXPECT_LT(std::abs(mean), 4.0 * std::sqrt(variance / 64.0));
    EXPECT_LT(std::sqrt(variance / 64.0), 0.01);
}

TEST(InstantCache, IsThereOnlyWhereVplsAre) {
    const auto has = [](const Scene& scene, const RenderSettings& settings, KernelId kernel) {
        const std::vector<KernelId> kernels =
            kernels_of(plan_for(flatten(scene), settings), components());
        return std::find(kernels.begin(), kernels.end(), kernel) != kernels.end();
    };
    const RenderSettings cached = settings_of(Algorithm::ic, 8, 8);
    const Scene scene = furnished_box();
    EXPECT_TRUE(has(scene, cached, KernelId::cache_lookup));
    EXPECT_FALSE(has(scene, cached, KernelId::vpl_gather));
    EXPECT_FALSE(has(scene, settings_of(Algorithm::igi, 8, 8), KernelId::cache_lookup));
    Scene black = scene;
    for (Material& material : black.materials) set_diffuse_albedo(material, glm::vec3(0.0F));
    EXPECT_FALSE(has(black, cached, KernelId::cache_lookup));
    EXPECT_FALSE(has(black, cached, KernelId::cache_records));
    RenderSettings direct = cached;
    direct.direct = true;
    direct.indirect = false;
    EXPECT_FALSE(has(scene, direct, KernelId::cache_tiles));
}

TEST(InstantCache, AFrameThatEndsEarlyIsDefined) {
    const Scene scene = furnished_box();
    const FlatScene flat = flatten(scene);
    for (const TestBackend backend : test::light_backends()) {
        Renderer renderer(test::shared_executor(backend), flat, front_camera(),
                          settings_of(Algorithm::ic, 64, 48));
        int asked = 0;
        EXPECT_FALSE(renderer.render_frame([&](Stage, double) { return ++asked < 6; }));
        const Rendering part{renderer.image(), renderer.stats(), renderer.plan()};
        test::expect_clean(part);
        EXPECT_TRUE(renderer.render_frame({}));
    }
}

}  // namespace
}  // namespace weft::instant_cache_test
