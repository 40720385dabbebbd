// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/testing/path_fixture.h"
#include "tests/testing/render_fixture.h"
#include "tests/testing/room_scenes.h"

namespace weft::irradiance_cache_test {
namespace {

using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;

RenderSettings settings_of(std::uint32_t width, std::uint32_t height, std::uint32_t rays = 256) {
    RenderSettings settings = test::small_settings(Algorithm::irradiance_cache, width, height);
    settings.sampling.cache_rays = rays;
    settings.direct = false;
    return settings;
}

Camera inside() {
    return test::look_at({0.2, 0.1, 0.7}, {-0.1, -0.2, -0.5}, 1.4);
}

Camera facing_ball() {
    return test::look_at({0.5, 0.2, 0.9}, {-0.2, -0.3, -0.4}, 1.1);
}

/// An open room with a smooth ball, under lights of every kind.
const FlatScene& open_room() {
    static const FlatScene flat = [] {
        SceneBuilder builder;
        test::add_open_room(builder);
        test::add_screen(builder);
        Mesh ball = test::icosphere(3, false);
        ball.normals = ball.positions;
        builder.add(std::move(ball), builder.material({0.5F, 0.6F, 0.7F}),
                    test::placement(0.35, {-0.4, -0.65, 0.1}));
        builder.add(test::quad_mesh({-0.3F, 0.9F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                    builder.material(glm::vec3(0.2F), {5.0F, 6.0F, 7.0F}));
        builder.light(LightType::point, {0.5, 0.3, 0.4}, glm::vec3(0.2F));
        builder.light(LightType::directional, {}, glm::vec3(0.3F), {-0.4, -0.8, -0.5});
        builder.scene.environment = Environment{{0.1F, 0.1F, 0.2F}};
        return flatten(builder.scene);
    }();
    return flat;
}

std::uint64_t rays_of(const Rendering& rendering) {
    std::uint64_t rays = 0;
    for (const FrameStats& frame : rendering.stats) rays += frame.rays;
    return rays;
}

/// Mean irradiance of all pixels by indirect light.
double mean_irradiance(const Rendering& rendering, std::uint32_t channel) {
    double sum = 0.0;
    for (std::uint32_t y = 0; y < rendering.image.height; ++y)
        for (std::uint32_t x = 0; x < rendering.image.width; ++x)
            sum += rendering.irradiance("indirect", x, y, channel);
    return sum / (static_cast<double>(rendering.image.width) * rendering.image.height);
}

TEST(IrradianceCache, RecordsOfAFurnaceHaveItsLight) {
    // A closed room whose walls all emit e and reflect rho: light that has been reflected has the
    // radiance e rho / (1 - rho) everywhere, so records have pi times that; what their rays meet of
    // emission does not count. With an allowed error of 0 every pixel is a record, none serves
    // others, and images are unbiased. Means of 16 seeds by Student's t with 15 degrees of
    // freedom at 6 standard errors: one such comparison of a correct renderer fails in 40,000, and
    // there are 9.
    const glm::vec3 emission(1.0F, 2.0F, 0.5F);
    const glm::vec3 albedo(0.5F, 0.8F, 0.2F);
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(albedo, emission));
    validate_scene(builder.scene);
    const FlatScene flat = flatten(builder.scene);
    RenderSettings settings = settings_of(24, 18, 32);
    settings.sampling.cache_error = 0.0;
    for (const TestBackend backend : test::light_backends()) {
        std::vector<std::vector<double>> means(3);
        for (settings.seed = 0; settings.seed < 16; ++settings.seed) {
            const Rendering rendering =
                test::render_flat(test::shared_executor(backend), flat, inside(), settings);
            test::expect_clean(rendering);
            for (std::uint32_t c = 0; c < 3; ++c) means[c].push_back(mean_irradiance(rendering, c));
        }
        for (std::uint32_t c = 0; c < 3; ++c) {
            const double rho = test::at(albedo, c);
            const double expected = pi * test::at(emission, c) * rho / (1.0 - rho);
            const auto [mean, error] = test::estimate(means[c]);
            EXPECT_LE(error, 0.01 * expected) << "channel " << c;
            EXPECT_NEAR(mean, expected, 6.0 * error + 1e-5 * expected)
                << test::backend_name(backend) << " channel " << c;
        }
    }
}

TEST(IrradianceCache, AnIntegratingSphereIsEvenlyLit) {
    // I / R^2 rho / (1 - rho) everywhere. A record's 252 paths leave an error of some 5 % of it at
    // random, its slopes some 2 % more at the end of its reach; over some hundred records that is
    // well below 1 % of the mean.
    SceneBuilder builder;
    builder.add(test::icosphere(5, true), builder.material({0.5F, 0.8F, 0.1F}));
    builder.light(LightType::point, {0, 0, 0}, glm::vec3(2.0F));
    RenderSettings settings = settings_of(64, 48);
    settings.sampling.cache_error = 0.2;
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering =
            test::render(backend, builder.scene,
                         test::look_at({0.1, -0.2, 0.3}, {-0.5, 0.3, -0.8}, 1.2), settings);
        test::expect_clean(rendering);
        for (std::uint32_t c = 0; c < 3; ++c) {
            const double rho = c == 0 ? 0.5 : c == 1 ? 0.8 : 0.1;
            const double expected = 2.0 * rho / (1.0 - rho);
            EXPECT_NEAR(mean_irradiance(rendering, c) / expected, 1.0, 0.02) << "channel " << c;
            double square = 0.0;
            for (std::uint32_t y = 0; y < 48; ++y)
                for (std::uint32_t x = 0; x < 64; ++x)
                    square +=
                        std::pow(rendering.irradiance("indirect", x, y, c) / expected - 1.0, 2.0);
            EXPECT_LT(std::sqrt(square / (64.0 * 48.0)), 0.2) << "channel " << c;
        }
        // Each cell takes three rays or more. Records are few, or nothing would be cached.
        EXPECT_LT(rays_of(rendering), 64U * 48U * 252U * 3U / 2U);
    }
}

TEST(IrradianceCache, AgreesWithPathTracing) {
    // The reference has 512 paths a pixel, which leave some 7 % of noise. Records add theirs, some
    // 8 %, and what interpolation makes of corners: the squares of these are 0.01 together. The
    // error of eight frames is less than that of one, because they trace other rays.
    const FlatScene& flat = test::room_with_ball();
    PathSettings reference_settings = test::path_settings(48, 36, 512, 7);
    reference_settings.through_centres = true;
    const Rendering reference = test::path_image(test::shared_executor(TestBackend::embree), flat,
                                                 facing_ball(), reference_settings);
    const std::vector<float>& expected = reference.layer("indirect");
    for (const TestBackend backend : test::light_backends()) {
        SCOPED_TRACE(test::backend_name(backend));
        Executor& executor = test::shared_executor(backend);
        const Rendering once =
            test::render_flat(executor, flat, facing_ball(), settings_of(48, 36));
        const Rendering often =
            test::render_flat(executor, flat, facing_ball(), settings_of(48, 36), 8);
        test::expect_clean(often);
        const double error = test::relative_mse(expected, once.layer("indirect"));
        EXPECT_LT(error, 0.03);
        EXPECT_LT(test::relative_mse(expected, often.layer("indirect")), error);
        EXPECT_NEAR(test::mean_of(often.layer("indirect")) / test::mean_of(expected), 1.0, 0.03);
    }
}

TEST(IrradianceCache, LightStraightFromLightsIsNotIndirect) {
    // A floor that sees a black area light and the sky alone.
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}),
                builder.material(glm::vec3(0.7F)));
    builder.add(test::quad_mesh({-0.5F, 1.0F, -0.5F}, {1, 0, 0}, {0, 0, 1}),
                builder.material(glm::vec3(0.0F), glm::vec3(4.0F)));
    builder.light(LightType::point, {0.3, 0.5, 0.2}, glm::vec3(1.0F));
    builder.scene.environment = Environment{{0.5F, 0.25F, 2.0F}};
    RenderSettings settings = settings_of(32, 24);
    settings.direct = true;
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::render(
            backend, builder.scene, test::look_at({0, 1.5, 2.5}, {0, 0.2, 0}, 0.8), settings);
        test::expect_clean(rendering);
        EXPECT_EQ(test::mean_of(rendering.layer("indirect")), 0.0);
        EXPECT_GT(test::mean_of(rendering.layer("direct")), 0.01);
    }
}

TEST(IrradianceCache, EveryPixelThatReflectsHasLight) {
    const FlatScene& flat = test::room_with_ball();
    for (const double error : {0.2, 0.1, 1e-3}) {
        RenderSettings settings = settings_of(61, 45, 32);
        settings.sampling.cache_error = error;
        const Rendering cached = test::render_flat(test::shared_executor(TestBackend::own_bvh),
                                                   flat, facing_ball(), settings);
        test::expect_clean(cached);
        std::size_t dark = 0;
        for (std::uint32_t y = 0; y < 45; ++y)
            for (std::uint32_t x = 0; x < 61; ++x)
                dark += cached.at("albedo", x, y) > 0.0F && !(cached.at("indirect", x, y) > 0.0F);
        EXPECT_EQ(dark, 0U) << "error " << error;
    }
}

TEST(IrradianceCache, ASmallerErrorTakesMoreRecords) {
    const FlatScene& flat = test::room_with_ball();
    std::uint64_t before = 0;
    for (const double error : {0.5, 0.2, 0.05}) {
        RenderSettings settings = settings_of(96, 72, 16);
        settings.sampling.cache_error = error;
        const std::uint64_t rays = rays_of(test::render_flat(
            test::shared_executor(TestBackend::own_bvh), flat, facing_ball(), settings));
        EXPECT_GT(rays, before) << "error " << error;
        before = rays;
    }
}

TEST(IrradianceCache, BackendsWidthsAndThreadsGiveTheSameBits) {
    const Camera camera = test::look_at({0.3, 0.1, 2.6}, {-0.1, -0.1, 0.0}, 0.8);
    RenderSettings settings = settings_of(61, 45, 16);
    settings.direct = true;
    settings.seed = 3;
    const auto image = [&](Executor& executor) {
        return test::render_flat(executor, open_room(), camera, settings, 2);
    };
    const Rendering reference = image(*test::make_executor(TestBackend::own_bvh, 1, 1));
    for (const TestBackend backend : {TestBackend::own_bvh, TestBackend::opencl}) {
        if (backend == TestBackend::opencl && !test::has_opencl()) continue;
        for (const std::uint32_t lanes : {1U, 4U, 8U, 16U}) {
            // Building kernels for a driver takes longer than running them here.
            if (backend == TestBackend::opencl && lanes % 4 == 0 && lanes != 16) continue;
            const Rendering other = image(*test::make_executor(backend, lanes, 2));
            EXPECT_EQ(test::differing_values(reference.image, other.image), 0U)
                << test::backend_name(backend) << ", " << lanes << " lanes";
            EXPECT_EQ(rays_of(reference), rays_of(other));
        }
    }
    const Rendering one = image(*test::make_executor(TestBackend::embree, 8, 1));
    const Rendering two = image(*test::make_executor(TestBackend::embree, 8, 2));
    EXPECT_EQ(test::differing_values(one.image, two.image), 0U);
    settings.seed = 4;
    EXPECT_GT(test::differing_values(reference.image,
                                     image(test::shared_executor(TestBackend::own_bvh)).image),
              0U);
}

TEST(IrradianceCache, RecordsInSeveralBatchesHaveTheirOwnLight) {
    // 16344 cells a record leave 128 records a batch, and the last of the five rounds makes more.
    // Each pixel is a record, in a furnace: pi rho / (1 - rho), within the noise of its rays, whose
    // radiance has a standard deviation below its mean: 4 % is five standard errors and more.
    SceneBuilder builder;
    builder.add(test::icosphere(2, true), builder.material(glm::vec3(0.1F), glm::vec3(1.0F)));
    RenderSettings settings = settings_of(15, 14, 16384);
    settings.sampling.cache_error = 0.0;
    const Rendering rendering =
        test::render(TestBackend::own_bvh, builder.scene, inside(), settings);
    test::expect_clean(rendering);
    const double expected = pi * 0.1 / 0.9;
    for (std::uint32_t y = 0; y < 14; ++y)
        for (std::uint32_t x = 0; x < 15; ++x)
            EXPECT_NEAR(rendering.irradiance("indirect", x, y), expected, 0.04 * expected)
                << x << ' ' << y;
}

TEST(IrradianceCache, TracesNoVirtualLights) {
    const auto kernels = [](const FlatScene& flat, const RenderSettings& settings) {
        std::set<std::string> names;
        for (const KernelId kernel : kernels_of(plan_for(flat, settings)))
            names.insert(std::string(kernel_name(kernel)));
        return names;
    };
    const std::set<std::string> always{"gbuffer", "compose"};
    std::set<std::string> traced = always;
    traced.insert(
        {"receivers", "cache_tiles", "cache_lookup", "hemisphere_rays", "hemisphere_records"});
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.5F), glm::vec3(1.0F)));
    const FlatScene flat = flatten(builder.scene);
    EXPECT_EQ(kernels(flat, settings_of(8, 8)), traced);
    for (Material& material : builder.scene.materials)
        set_diffuse_albedo(material, glm::vec3(0.0F));
    EXPECT_EQ(kernels(flatten(builder.scene), settings_of(8, 8)), always);
    RenderSettings neither = settings_of(8, 8);
    neither.indirect = false;
    EXPECT_EQ(kernels(flat, neither), always);
    RenderSettings gathered = settings_of(8, 8);
    gathered.algorithm = Algorithm::ic;
    EXPECT_EQ(kernels(flat, gathered).count("hemisphere_rays"), 0U);
}

TEST(IrradianceCache, AFrameThatEndsEarlyIsDefined) {
    const FlatScene& flat = test::room_with_ball();
    for (const TestBackend backend : test::light_backends())
        for (const int most : {0, 3, 6, 9}) {
            Renderer renderer(test::shared_executor(backend), flat, facing_ball(),
                              settings_of(64, 48, 16));
            int asked = 0;
            EXPECT_FALSE(renderer.render_frame([&](Stage, double) { return ++asked < most; }));
            const Rendering part{renderer.image(), renderer.stats(), renderer.plan()};
            test::expect_clean(part);
            EXPECT_TRUE(renderer.render_frame({}));
        }
}

}  // namespace
}  // namespace weft::irradiance_cache_test
