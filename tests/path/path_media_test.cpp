// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/testing/media_builder.h"
#include "tests/testing/path_fixture.h"

// Path tracing through participating media where the light is known: furnaces, airlight, slabs.
//
// Comparisons allow what sidak_limit gives for 300 of them (about 5.1 standard errors), more than
// this file makes; seeds are fixed, and standard errors are bounded.
namespace weft::path_media_test {
namespace {

using test::add_boundary;
using test::at;
using test::cube_mesh;
using test::medium_of;
using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;
using test::Tolerance;

constexpr double pi = std::numbers::pi;
constexpr std::size_t comparisons = 300;

void expect_beauty(const Rendering& rendering, const glm::vec3& expected, double error,
                   const std::string& what) {
    for (std::uint32_t c = 0; c < 3; ++c)
        test::expect_estimate(test::beauty_of(rendering, c), at(expected, c),
                              Tolerance{comparisons, error, 1e-5},
                              what + " channel " + std::to_string(c));
}

TEST(PathMedia, WhiteMediaVanishInTheEnvironment) {
    const glm::vec3 radiance(1.0F, 2.0F, 0.5F);
    for (const auto& [sigma, g] :
         {std::pair{glm::vec3(0.1F), 0.0F}, std::pair{glm::vec3(2.0F), 0.8F},
          std::pair{glm::vec3(10.0F), -0.5F}, std::pair{glm::vec3(0.5F, 1.0F, 4.0F), 0.3F},
          std::pair{glm::vec3(0.0F, 1.0F, 0.0F), 0.0F}, std::pair{glm::vec3(3.0F), 0.999F}}) {
        SceneBuilder builder;
        builder.scene.environment = Environment{radiance};
        builder.scene.media.push_back(medium_of(sigma, glm::vec3(1.0F), g));
        add_boundary(builder.scene, test::icosphere(1, false), glm::dmat4(1.0), 0);
        for (const TestBackend backend : test::light_backends())
            for (const double distance : {3.0, 0.4}) {
                const Rendering rendering =
                    test::path_image(backend, builder.scene,
                                     test::look_at({0.0, 0.1, distance}, {0.1, 0.0, -1.0}, 0.5),
                                     test::path_settings(24, 24, 64));
                expect_beauty(rendering, radiance, 0.02,
                              std::string(test::backend_name(backend)) + " furnace from " +
                                  std::to_string(distance));
            }
    }
}

TEST(PathMedia, WhiteSurfacesInWhiteMediaVanish) {
    const glm::vec3 radiance(1.0F, 2.0F, 0.5F);
    SceneBuilder builder;
    builder.scene.environment = Environment{radiance};
    builder.add(test::icosphere(1, false), builder.material(glm::vec3(1.0F)),
                test::placement(0.5, {0.1, 0.0, 0.0}));
    builder.scene.media.push_back(medium_of({1.0F, 2.0F, 0.3F}, glm::vec3(1.0F), 0.4F));
    builder.scene.media.push_back(medium_of({0.2F, 0.5F, 4.0F}, glm::vec3(1.0F), -0.4F));
    add_boundary(builder.scene, cube_mesh(), test::placement(1.1, {0.0, 0.0, 0.0}), 0);
    // Overlaps the surface, the first boundary and clear air.
    add_boundary(builder.scene, test::icosphere(1, false), test::placement(0.7, {0.8, 0.1, 0.0}),
                 1);
    for (const TestBackend backend : test::light_backends())
        expect_beauty(test::path_image(backend, builder.scene,
                                       test::look_at({0.5, 0.6, 4.0}, {0.2, 0.0, 0.0}, 0.5),
                                       test::path_settings(24, 24, 128)),
                      radiance, 0.02, test::backend_name(backend));
}

TEST(PathMedia, AirlightOfAPointLight) {
    // Sun et al. 2005: beta = 0.3, I = 2, light 1.5 away at 0.9 rad from the ray, wall 4 away.
    constexpr double gamma = 0.9;
    SceneBuilder builder;
    builder.scene.media.push_back(medium_of(glm::vec3(0.3F), glm::vec3(1.0F)));
    builder.scene.camera_medium = 0;
    builder.add(test::quad_mesh({-0.1F, -0.1F, -4.0F}, {0.2F, 0.0F, 0.0F}, {0.0F, 0.2F, 0.0F}),
                builder.material(glm::vec3(0.0F)));
    PunctualLight light;
    light.intensity = glm::vec3(2.0F, 1.0F, 4.0F);
    light.position = {1.5 * std::sin(gamma), 0.0, -1.5 * std::cos(gamma)};
    builder.scene.lights.push_back(light);
    const Camera camera = test::look_at({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 1e-4);
    builder.scene.cameras.push_back(camera);
    PathSettings settings = test::path_settings(32, 32, 64);
    settings.indirect = false;
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::path_image(backend, builder.scene, camera, settings);
        for (std::uint32_t c = 0; c < 3; ++c)
            test::expect_estimate(test::layer_of(rendering, "direct", c),
                                  0.03389058698 * at(light.intensity, c) / 2.0,
                                  Tolerance{comparisons, 0.004, 1e-5}, test::backend_name(backend));
    }
}

TEST(PathMedia, SlabsLeaveTheirTransmittance) {
    // An emitting wall behind a slab that absorbs, or scatters and absorbs.
    const glm::vec3 radiance(1.0F, 2.0F, 0.5F);
    const glm::vec3 sigma(0.25F, 1.0F, 3.0F);
    for (const float albedo : {0.0F, 0.9F})
        for (const double from : {3.0, 0.0}) {
            SceneBuilder builder;
            builder.add(
                test::quad_mesh({-9.0F, -9.0F, -2.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 18.0F, 0.0F}),
                builder.material(glm::vec3(0.0F), radiance));
            builder.scene.media.push_back(medium_of(sigma, glm::vec3(albedo)));
            add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
            const double depth = from > 1.0 ? 2.0 : 1.0;
            for (const TestBackend backend : test::light_backends()) {
                const Rendering rendering = test::path_image(
                    backend, builder.scene, test::look_at({0, 0, from}, {0, 0, -9}, 1e-4),
                    test::path_settings(16, 16, 64));
                for (std::uint32_t c = 0; c < 3; ++c) {
                    const double expected = at(radiance, c) * std::exp(-depth * at(sigma, c));
                    test::expect_shine(rendering, c, expected, albedo > 0.0F,
                                       Tolerance{comparisons, 0.1, 1e-5}, 3e-6,
                                       test::backend_name(backend));
                }
            }
        }
}

TEST(PathMedia, TheSmallerOfOverlappingBoundariesCounts) {
    // From z = 5 through fog without end: into a cube of 1, through a small one of clear air in it,
    // to a wall. Extinctions are those of media 0 and 1.
    SceneBuilder builder;
    builder.add(test::quad_mesh({-9.0F, -9.0F, -3.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 18.0F, 0.0F}),
                builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    builder.scene.media.push_back(medium_of(glm::vec3(0.1F), glm::vec3(0.0F)));
    builder.scene.media.push_back(medium_of(glm::vec3(0.5F), glm::vec3(0.0F)));
    builder.scene.outer_medium = 0;
    add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 1, 0);
    add_boundary(builder.scene, cube_mesh(), test::placement(0.25, {0.0, 0.0, 0.5}), -1, 1);
    struct Case {
        double from, depth;
    };
    for (const auto& [from, depth] :
         {Case{5.0, 0.1 * 6.0 + 0.5 * 1.5}, Case{0.5, 0.1 * 2.0 + 0.5 * 1.25},
          Case{-0.5, 0.1 * 2.0 + 0.5 * 0.5}, Case{1.0, 0.1 * 2.0 + 0.5 * 1.5}})
        for (const TestBackend backend : test::light_backends()) {
            const Rendering rendering = test::path_image(
                backend, builder.scene, test::look_at({0, 0, from}, {0, 0, -9}, 1e-4),
                test::path_settings(4, 4, 4));
            for (const double value : test::channel_of(rendering, "", 0))
                ASSERT_NEAR(value, std::exp(-depth), 5e-6) << from;
        }
}

TEST(PathMedia, SurfacesAreLitThroughMedia) {
    // A point light above a floor, all in a medium that absorbs: exactly known. The boundary's
    // lower face lies in the floor.
    const glm::vec3 sigma(0.2F, 1.0F, 3.0F);
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1.0F, -1.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}),
                builder.material(glm::vec3(0.5F)));
    builder.scene.media.push_back(medium_of(sigma, glm::vec3(0.0F)));
    add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
    PunctualLight light;
    light.intensity = glm::vec3(3.0F);
    light.position = {0.3, 0.2, 0.0};
    builder.scene.lights.push_back(light);
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::path_image(
            backend, builder.scene, test::look_at({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, 1e-4),
            test::path_settings(4, 4, 4));
        const double d = std::sqrt(0.09 + 1.44);
        for (std::uint32_t c = 0; c < 3; ++c)
            for (const double value : test::channel_of(rendering, "", c)) {
                const double expected =
                    0.5 / pi * 3.0 * (1.2 / d) / (d * d) * std::exp(-(1.0 + d) * at(sigma, c));
                ASSERT_NEAR(value, expected, 2e-4 * expected);
            }
    }
}

/// Light of a square of radiance 1 that the ray from the origin along -z receives by single
/// scattering up to `depth`, by quadrature.
double scattered_once(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
                      double sigma, double albedo, double g, double depth) {
    constexpr int steps = 400;
    constexpr int cells = 40;
    const glm::dvec3 normal = glm::normalize(glm::cross(u, v));
    const double cell = glm::length(glm::cross(u, v)) / (cells * cells);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps * depth;
        for (int j = 0; j < cells * cells; ++j) {
            const double a = (j % cells + 0.5) / cells;
            const double b = (j / cells + 0.5) / cells;
            const glm::dvec3 to = corner + a * u + b * v - glm::dvec3(0, 0, -t);
            const double d = glm::length(to);
            const double facing = -glm::dot(to, normal) / d;
            if (facing <= 0.0) continue;
            // Light travels against `to`, and on against the ray.
            const double cosine = glm::dot(to / d, glm::dvec3(0, 0, -1));
            const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
            sum += depth / steps * sigma * albedo * phase * std::exp(-sigma * (t + d)) * facing /
                   (d * d) * cell;
        }
    }
    return sum;
}

TEST(PathMedia, SingleScatteringOfAnAreaLight) {
    const glm::vec3 corner(0.5F, -0.5F, -2.0F);
    const glm::vec3 u(0.0F, 0.0F, 1.0F);
    const glm::vec3 v(0.0F, 1.0F, 0.0F);
    for (const float g : {0.0F, 0.8F, -0.6F}) {
        SceneBuilder builder;
        const glm::vec3 sigma(0.3F, 1.0F, 2.0F);
        builder.add(test::quad_mesh(corner, u, v),
                    builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
        builder.add(test::quad_mesh({-0.1F, -0.1F, -3.0F}, {0.2F, 0.0F, 0.0F}, {0.0F, 0.2F, 0.0F}),
                    builder.material(glm::vec3(0.0F)));
        builder.scene.media.push_back(medium_of(sigma, glm::vec3(0.8F, 1.0F, 0.5F), g));
        add_boundary(builder.scene, cube_mesh(), test::placement(20.0, {0.0, 0.0, 0.0}), 0);
        std::vector<double> expected;
        for (std::uint32_t c = 0; c < 3; ++c)
            expected.push_back(scattered_once(corner, u, v, at(sigma, c),
                                              at(builder.scene.media[0].albedo, c),
                                              static_cast<double>(g), 3.0));
        PathSettings settings = test::path_settings(32, 32, 128);
        settings.indirect = false;
        for (const TestBackend backend : test::light_backends()) {
            const Rendering rendering = test::path_image(
                backend, builder.scene, test::look_at({0, 0, 0}, {0, 0, -1}, 1e-4), settings);
            for (std::uint32_t c = 0; c < 3; ++c) {
                ASSERT_GT(expected[c], 0.0);
                test::expect_estimate(test::layer_of(rendering, "direct", c), expected[c],
                                      Tolerance{comparisons, 0.01, 5e-4},
                                      std::string(test::backend_name(backend)) + " g " +
                                          std::to_string(g) + " channel " + std::to_string(c));
            }
        }
    }
}

/// A room with an area light, fog in a box and a hole in it.
SceneBuilder foggy_room() {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.7F, 0.5F, 0.3F}));
    builder.add(test::quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.4F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    PunctualLight light;
    light.position = {0.4, 0.1, -0.3};
    builder.scene.lights.push_back(light);
    builder.scene.media.push_back(medium_of({0.3F, 1.0F, 2.0F}, {0.9F, 0.8F, 0.7F}, 0.5F));
    add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
    add_boundary(builder.scene, test::icosphere(1, false), test::placement(0.3, {0, -0.4, 0}), -1);
    return builder;
}

TEST(PathMedia, SameBitsOnDevicesAndInParts) {
    const Scene scene = foggy_room().scene;
    const Camera camera = test::look_at({0.1, 0.2, 0.9}, {0.0, -0.2, 0.0}, 1.2);
    const FlatScene flat = flatten(scene);
    Executor& own = test::shared_executor(TestBackend::own_bvh);
    const FilmSums whole = test::path_sums(own, flat, camera, test::path_settings(24, 16, 8));
    PathSettings half = test::path_settings(24, 16, 8);
    half.samples = {0, 3};
    const FilmSums first = test::path_sums(own, flat, camera, half);
    half.samples = {3, 8};
    EXPECT_EQ(test::path_sums(own, flat, camera, half, first).words, whole.words);
    const auto single = test::make_executor(TestBackend::own_bvh, 0, 1);
    EXPECT_EQ(test::path_sums(*single, flat, camera, test::path_settings(24, 16, 8)).words,
              whole.words);
    if (!test::has_opencl()) GTEST_SKIP() << "no OpenCL device";
    EXPECT_EQ(test::path_sums(test::shared_executor(TestBackend::opencl), flat, camera,
                              test::path_settings(24, 16, 8))
                  .words,
              whole.words);
}

TEST(PathMedia, ClearMediaChangeNothing) {
    Scene scene = foggy_room().scene;
    const Camera camera = test::look_at({0.1, 0.2, 0.9}, {0.0, -0.2, 0.0}, 1.2);
    scene.media[0].scale = 0.0F;
    const FlatScene clear = flatten(scene);
    EXPECT_FALSE(clear.media.present());
    scene.media.clear();
    scene.medium_boundaries.clear();
    const FlatScene none = flatten(scene);
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const PathSettings settings = test::path_settings(16, 16, 4);
    const FilmSums a = test::path_sums(executor, clear, camera, settings);
    const FilmSums b = test::path_sums(executor, none, camera, settings);
    EXPECT_EQ(a.words, b.words);
    EXPECT_EQ(a.identity, b.identity);
}

TEST(PathMedia, HostileMediaStayFinite) {
    // Enormous and tiny extinction, phase functions like needles, fog without end or light, the
    // light and the camera on boundaries. path_sums expects every value to be finite.
    for (const float sigma : {1e-30F, 1e6F, 1e30F})
        for (const float g : {0.0F, 0.99999994F, -0.99999994F}) {
            Scene scene = foggy_room().scene;
            scene.media[0] = medium_of({sigma, 1.0F, 0.0F}, glm::vec3(0.9F), g);
            scene.lights[0].position = {0.0, 0.0, 0.0};
            for (const glm::dvec3& from : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 0.0, 0.5)})
                (void)test::path_image(TestBackend::own_bvh, scene,
                                       test::look_at(from, {0.0, 0.0, 0.0}, 1.0),
                                       test::path_settings(9, 9, 8));
            scene.medium_boundaries.clear();
            scene.instances.clear();
            scene.outer_medium = 0;
            (void)test::path_image(TestBackend::own_bvh, scene,
                                   test::look_at({0, 0, 1}, {0, 0, 0}, 1.0),
                                   test::path_settings(9, 9, 8));
            scene.lights.clear();
            (void)test::path_image(TestBackend::own_bvh, scene,
                                   test::look_at({0, 0, 1}, {0, 0, 0}, 1.0),
                                   test::path_settings(9, 9, 8));
        }
}

}  // namespace
}  // namespace weft::path_media_test
