// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "plan/algorithm.h"
#include "tests/testing/environment_images.h"
#include "tests/testing/floor_scenes.h"
#include "tests/testing/media_builder.h"
#include "tests/testing/path_fixture.h"

// An image of the environment in whole images: what the camera sees of it, and the light that
// surfaces and media get from it, alone and among other lights, by path tracing and by the
// components of previews. Irradiances are compared with integrals of a reference implementation
// (tests/testing/environment_images.h), by standard errors as in path_lights_test.cpp.
namespace weft::path_environment_test {
namespace {

using test::eye_offset;
using test::floor_scene;
using test::radiance;
using test::receiver_albedo;
using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;
constexpr std::size_t comparisons = 100;

Environment environment_of(const EnvironmentImage& image,
                           const glm::dmat3& to_world = glm::dmat3(1.0)) {
    return {glm::vec3(1.0F), std::make_shared<const EnvironmentImage>(image), to_world};
}

/// From the image's +y to +z, above the floors of tests.
const glm::dmat3 upright{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};

TEST(PathEnvironment, TheCameraSeesATexelWhereItIs) {
    // A single bright texel of 16 x 8, in the middle of the image of a camera that looks there.
    SceneBuilder builder;
    builder.add(test::quad_mesh({0, 0, 50}, {1, 0, 0}, {0, 1, 0}),
                builder.material(glm::vec3(0.5F)));
    const EnvironmentImage image = test::one_texel(16, 8, 11, 2, {4.0F, 2.0F, 1.0F});
    const glm::dvec3 towards = test::texel_direction(image, 11, 2);
    const glm::dmat3 quarter{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    for (const glm::dmat3& turn : {glm::dmat3(1.0), quarter}) {
        builder.scene.environment = environment_of(image, turn);
        const Camera camera = test::look_at({0, 0, 0}, turn * towards, 0.02);
        PathSettings settings = test::path_settings(3, 3, 1);
        settings.through_centres = true;
        const Rendering seen =
            test::path_image(TestBackend::own_bvh, builder.scene, camera, settings);
        const Rendering previewed = test::render(TestBackend::own_bvh, builder.scene, camera,
                                                 test::small_settings(Algorithm::ais, 3, 3));
        for (const Rendering* rendering : {&seen, &previewed}) {
            EXPECT_NEAR(rendering->at("emission", 1, 1, 0), 4.0, 1e-3);
            EXPECT_NEAR(rendering->at("emission", 1, 1, 2), 1.0, 1e-3);
            EXPECT_EQ(rendering->at("alpha", 1, 1), 1.0F);
        }
        const Rendering away =
            test::path_image(TestBackend::own_bvh, builder.scene,
                             test::look_at({0, 0, 0}, -(turn * towards), 0.02), settings);
        EXPECT_EQ(away.at("", 1, 1, 0), 0.0F);
        settings.hides_environment = true;
        const Rendering hidden =
            test::path_image(TestBackend::own_bvh, builder.scene, camera, settings);
        EXPECT_EQ(hidden.at("", 1, 1, 0), 0.0F);
        EXPECT_EQ(hidden.at("alpha", 1, 1), 0.0F);
    }
}

/// Direct light of path tracing at a point of the floor.
void expect_direct(TestBackend backend, const Scene& scene, const glm::dvec3& expected,
                   double error = 0.01, std::uint32_t samples = 256) {
    PathSettings settings = test::path_settings(16, 16, samples);
    settings.indirect = false;
    const Rendering rendering =
        test::path_image(backend, scene, test::look_at(eye_offset, {0, 0, 0}, 0.001), settings);
    for (std::uint32_t c = 0; c < 3; ++c) {
        const auto k = static_cast<glm::length_t>(c);
        test::expect_estimate(test::layer_of(rendering, "direct", c),
                              double(receiver_albedo[k]) / pi * expected[k],
                              {comparisons, error, 5e-4}, "channel " + std::to_string(c));
    }
}

TEST(PathEnvironment, FloorsGetTheIrradianceOfTheirHemisphere) {
    for (const EnvironmentImage& image : {test::constant_image(radiance), test::sunny_sky(),
                                          test::one_texel(8, 4, 5, 1, {3.0F, 2.0F, 1.0F}),
                                          test::one_texel(8, 4, 2, 0, {3.0F, 2.0F, 1.0F})}) {
        SceneBuilder builder = floor_scene();
        builder.scene.environment = environment_of(image, upright);
        builder.scene.environment->radiance = {0.5F, 1.0F, 2.0F};
        const glm::dvec3 expected =
            test::irradiance_by(image, {0, 1, 0}, image.width > 16 ? 4 : 32) *
            glm::dvec3(0.5, 1.0, 2.0);
        for (const TestBackend backend : test::light_backends())
            expect_direct(backend, builder.scene, expected);
    }
}

TEST(PathEnvironment, ASmallSunIsSampledWell) {
    // One texel of 512 x 256, whose light scattered rays find once in 50,000 times: 4096 samples
    // are enough for 2 %. The texel's tent is 2 texels wide.
    const EnvironmentImage image = test::one_texel(512, 256, 300, 60, glm::vec3(1e6F));
    const double angle = pi * 60.5 / 256.0;
    const double step = pi / 256.0;
    // The tent's integral over the angle times sin cos, whose curvature adds 1e-4.
    const double expected = 1e6 * step * step * std::sin(angle) * std::cos(angle);
    SceneBuilder builder = floor_scene();
    builder.scene.environment = environment_of(image, upright);
    expect_direct(TestBackend::own_bvh, builder.scene, glm::dvec3(expected), 0.02, 16);
}

TEST(PathEnvironment, AddsToOtherLights) {
    const EnvironmentImage image = test::sunny_sky();
    SceneBuilder builder = floor_scene();
    builder.scene.environment = environment_of(image, upright);
    builder.light(LightType::directional, {}, glm::vec3(3.0F), {0.0, 0.0, -1.0});
    builder.light(LightType::point, {0.0, 0.0, 2.0}, glm::vec3(8.0F));
    const glm::dvec3 expected =
        test::irradiance_by(image, {0, 1, 0}, 4) + glm::dvec3(3.0) + glm::dvec3(2.0);
    for (const TestBackend backend : test::light_backends())
        expect_direct(backend, builder.scene, expected);
    const FlatScene flat = flatten(builder.scene);
    EXPECT_EQ(choice_lights(flat), 3U);
    EXPECT_NE(flat.features & FEATURE_LIGHT_TREE, 0U);
}

TEST(PathEnvironment, WhiteThingsVanishInAConstantImage) {
    SceneBuilder builder;
    builder.scene.environment = environment_of(test::constant_image({1.0F, 2.0F, 0.5F}));
    builder.add(test::icosphere(1, false), builder.material(glm::vec3(1.0F)),
                test::placement(0.5, {0.1, 0.0, 0.0}));
    const auto expect_vanished = [&] {
        for (const TestBackend backend : test::light_backends()) {
            const Rendering rendering = test::path_image(
                backend, builder.scene, test::look_at({0.5, 0.6, 4.0}, {0.2, 0.0, 0.0}, 0.5),
                test::path_settings(24, 24, 128));
            for (std::uint32_t c = 0; c < 3; ++c)
                test::expect_estimate(test::beauty_of(rendering, c),
                                      c == 0   ? 1.0
                                      : c == 1 ? 2.0
                                               : 0.5,
                                      {comparisons, 0.01, 1e-4}, test::backend_name(backend));
        }
    };
    expect_vanished();
    // The same in a white medium.
    builder.scene.media.push_back(test::medium_of({1.0F, 2.0F, 0.3F}, glm::vec3(1.0F), 0.4F));
    test::add_boundary(builder.scene, test::cube_mesh(), test::placement(1.1, {0.0, 0.0, 0.0}), 0);
    expect_vanished();
}

TEST(PathEnvironment, ScattersInMediaAsAConstantEnvironmentDoes) {
    // A grey medium in front of nothing: an image of one colour gives what that colour gives.
    SceneBuilder builder;
    builder.add(test::quad_mesh({-9, -9, -3}, {1, 0, 0}, {0, 1, 0}),
                builder.material(glm::vec3(0.5F)));
    builder.scene.media.push_back(test::medium_of({1.0F, 2.0F, 0.5F}, {0.8F, 0.5F, 0.9F}, -0.3F));
    test::add_boundary(builder.scene, test::cube_mesh(), glm::dmat4(1.0), 0);
    const auto image_with = [&](const Environment& environment) {
        builder.scene.environment = environment;
        return test::path_image(TestBackend::own_bvh, builder.scene,
                                test::look_at({0.3, 0.4, 4.0}, {0.0, 0.0, 0.0}, 0.4),
                                test::path_settings(24, 24, 256, 5));
    };
    const glm::vec3 colour(1.0F, 2.0F, 0.5F);
    const Rendering constant = image_with(Environment{colour});
    const Rendering image = image_with(environment_of(test::constant_image(colour)));
    for (std::uint32_t c = 0; c < 3; ++c) {
        const test::Estimate a = test::beauty_of(constant, c);
        const test::Estimate b = test::beauty_of(image, c);
        EXPECT_LT(b.error, 0.003 * b.mean);
        EXPECT_NEAR(a.mean, b.mean, 4.9 * std::hypot(a.error, b.error)) << c;
    }
}

/// A floor with a white block in the sunny sky.
Scene block_in_the_sun() {
    SceneBuilder builder = floor_scene();
    builder.scene.environment = environment_of(test::sunny_sky(), upright);
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.8F)),
                test::placement(0.4, {0.1, 0.2, 0.4}));
    builder.light(LightType::point, {1.0, 0.5, 2.0}, glm::vec3(2.0F));
    return std::move(builder.scene);
}

TEST(PathEnvironment, AllBackendsMakeTheSameImages) {
    const Scene scene = block_in_the_sun();
    const FlatScene flat = flatten(scene);
    const Camera camera = test::look_at({1.0, -2.5, 1.6}, {0.0, 0.0, 0.2}, 0.9);
    if (!test::has_opencl()) GTEST_SKIP() << "there is no OpenCL device";
    Executor& native = test::shared_executor(TestBackend::own_bvh);
    Executor& opencl = test::shared_executor(TestBackend::opencl);
    const PathSettings settings = test::path_settings(32, 24, 4);
    test::expect_same_sums(test::path_sums(native, flat, camera, settings),
                           test::path_sums(opencl, flat, camera, settings));
    for (const Algorithm algorithm : {Algorithm::ais, Algorithm::irradiance_cache}) {
        const RenderSettings preview = test::small_settings(algorithm, 32, 24);
        const Rendering a = test::render_flat(native, flat, camera, preview);
        const Rendering b = test::render_flat(opencl, flat, camera, preview);
        test::expect_clean(a);
        EXPECT_EQ(test::differing_values(a.image, b.image), 0U) << to_string(algorithm);
    }
}

TEST(PathEnvironment, PreviewsAreAsBrightAsPaths) {
    // Means of whole images over 64 frames: those of igi with compensation lack nothing.
    const FlatScene flat = flatten(block_in_the_sun());
    const Camera camera = test::look_at({1.0, -2.5, 1.6}, {0.0, 0.0, 0.2}, 0.9);
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const Rendering reference =
        test::path_image(executor, flat, camera, test::path_settings(24, 16, 1024));
    for (const Algorithm algorithm : {Algorithm::ir, Algorithm::ais}) {
        const RenderSettings settings = test::small_settings(algorithm, 24, 16);
        const Rendering preview = test::render_flat(executor, flat, camera, settings, 64);
        for (const char* layer : {"direct", "emission"}) {
            const double expected = test::mean_of(reference.layer(layer));
            EXPECT_NEAR(test::mean_of(preview.layer(layer)), expected, 0.02 * expected)
                << layer << ' ' << to_string(algorithm);
        }
        const double indirect = test::mean_of(reference.layer("indirect"));
        EXPECT_NEAR(test::mean_of(preview.layer("indirect")), indirect, 0.1 * indirect)
            << to_string(algorithm);
    }
}

TEST(PathEnvironment, TheFilmHasRoomForTheSun) {
    // A pixel that shows a sun of 1e9: its sums hold it.
    SceneBuilder builder;
    builder.add(test::quad_mesh({0, 0, 50}, {1, 0, 0}, {0, 1, 0}),
                builder.material(glm::vec3(0.5F)));
    const EnvironmentImage image = test::one_texel(8, 4, 5, 1, glm::vec3(1e9F));
    builder.scene.environment = environment_of(image);
    const Rendering rendering =
        test::path_image(TestBackend::own_bvh, builder.scene,
                         test::look_at({0, 0, 0}, test::texel_direction(image, 5, 1), 1e-4),
                         test::path_settings(1, 1, 64));
    EXPECT_NEAR(rendering.at("", 0, 0), 1e9, 1e6);
}

}  // namespace
}  // namespace weft::path_environment_test
