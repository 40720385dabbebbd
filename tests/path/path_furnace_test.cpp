// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/testing/path_fixture.h"

// Path tracing in surroundings where radiance is known everywhere: furnaces, the integrating
// sphere, and plates without end.
//
// Pixels all have the same expectation. The mean of an image is compared with it by its standard
// error; the limit is that of 300 comparisons (sidak_limit: about 5.1 standard errors), more than
// this file makes, and the standard error itself is bounded.
namespace weft::path_furnace_test {
namespace {

using test::at;
using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;
using test::Tolerance;

constexpr double pi = std::numbers::pi;
constexpr std::size_t comparisons = 300;

std::string name_of(TestBackend backend, const std::string& what, std::uint32_t channel) {
    return std::string(test::backend_name(backend)) + " " + what + " channel " +
           std::to_string(channel);
}

/// That every order of light has its share of e / (1 - rho).
void expect_furnace(TestBackend backend, const Rendering& rendering, const glm::vec3& emission,
                    const glm::vec3& albedo, double largest_error) {
    for (std::uint32_t c = 0; c < 3; ++c) {
        const double e = at(emission, c);
        const double rho = at(albedo, c);
        for (const double value : test::channel_of(rendering, "emission", c))
            ASSERT_NEAR(value, e, 1e-6 * e);
        if (rho == 0.0) {
            for (const double value : test::channel_of(rendering, "", c))
                ASSERT_NEAR(value, e, 1e-6 * e);
            continue;
        }
        const Tolerance tolerance{comparisons, largest_error, 1e-5};
        test::expect_estimate(test::beauty_of(rendering, c), e / (1.0 - rho), tolerance,
                              name_of(backend, "beauty", c));
        const Tolerance layers{comparisons, 2.0 * largest_error, 1e-5};
        test::expect_estimate(test::layer_of(rendering, "direct", c), rho * e, layers,
                              name_of(backend, "direct", c));
        test::expect_estimate(test::layer_of(rendering, "indirect", c), rho * rho * e / (1.0 - rho),
                              layers, name_of(backend, "indirect", c));
    }
}

Camera inside() {
    return test::look_at({0.2, 0.1, 0.7}, {-0.1, -0.2, -0.5}, 1.4);
}

TEST(PathFurnace, ClosedRoomThatEmitsEverywhere) {
    for (const auto& [emission, albedo] :
         {std::pair{glm::vec3(1.0F, 2.0F, 0.5F), glm::vec3(0.5F, 0.9F, 0.0F)},
          std::pair{glm::vec3(3.0F, 1e-3F, 1.0F), glm::vec3(0.2F, 0.7F, 0.8F)}}) {
        SceneBuilder builder;
        builder.add(test::room_mesh(), builder.material(albedo, emission));
        for (const TestBackend backend : test::light_backends())
            expect_furnace(backend,
                           test::path_image(backend, builder.scene, inside(),
                                            test::path_settings(24, 24, 256)),
                           emission, albedo, 0.005);
    }
}

TEST(PathFurnace, HoldsWithObjectsWithin) {
    // Several lights of very different sizes, some of which hide others, and both sides of one.
    const glm::vec3 emission(1.0F, 2.0F, 0.5F);
    const glm::vec3 albedo(0.5F, 0.8F, 0.3F);
    SceneBuilder builder;
    const std::uint32_t material = builder.material(albedo, emission);
    const std::uint32_t both = builder.material(albedo, emission);
    builder.scene.materials[both].emission.both_sides = true;
    builder.add(test::room_mesh(), material);
    builder.add(test::icosphere(2, false), material, test::placement(0.3, {-0.3, -0.4, -0.2}));
    builder.add(test::icosphere(1, false), material, test::placement(0.01, {0.1, 0.0, 0.1}));
    builder.add(test::quad_mesh({0.2F, -0.8F, -0.6F}, {0.5F, 0.1F, 0.0F}, {0.0F, 0.7F, 0.2F}),
                both);
    for (const TestBackend backend : test::light_backends())
        expect_furnace(
            backend,
            test::path_image(backend, builder.scene, inside(), test::path_settings(24, 24, 256, 1)),
            emission, albedo, 0.005);
}

TEST(PathFurnace, WhiteConvexObjectsVanishInTheEnvironment) {
    // A path meets the object once, so that every sample is the same.
    const glm::vec3 radiance(1.0F, 2.0F, 0.5F);
    for (const float rho : {1.0F, 0.5F, 0.0F}) {
        SceneBuilder builder;
        builder.scene.environment = Environment{radiance};
        builder.add(test::icosphere(2, false), builder.material(glm::vec3(rho)));
        for (const TestBackend backend : test::light_backends()) {
            const Rendering rendering =
                test::path_image(backend, builder.scene, test::look_at({0, 0, 3}, {0, 0, 0}, 0.9),
                                 test::path_settings(24, 24, 16));
            double covered = 0.0;
            for (std::uint32_t y = 0; y < 24; ++y)
                for (std::uint32_t x = 0; x < 24; ++x) {
                    // Pixels at the edge see the object in a part of their samples.
                    const glm::vec3 normal{rendering.at("normal", x, y, 0),
                                           rendering.at("normal", x, y, 1),
                                           rendering.at("normal", x, y, 2)};
                    const bool object = rendering.at("depth", x, y) > 0.0F;
                    const bool whole = glm::length(normal) > 0.99F;
                    covered += whole ? 1.0 : 0.0;
                    if (object && !whole && rho < 1.0F) continue;
                    for (std::uint32_t c = 0; c < 3; ++c)
                        ASSERT_NEAR(rendering.at("", x, y, c),
                                    at(radiance, c) * (whole ? static_cast<double>(rho) : 1.0),
                                    2e-6 * at(radiance, c))
                            << x << ' ' << y;
                }
            EXPECT_GT(covered, 50.0);
        }
    }
}

TEST(PathFurnace, WhiteBowlsVanishInTheEnvironment) {
    // Open, so that paths end, but they may meet the inside often.
    const glm::vec3 radiance(1.0F, 2.0F, 0.5F);
    SceneBuilder builder;
    builder.scene.environment = Environment{radiance};
    Mesh box = test::room_mesh();
    box.triangles.resize(10);  // without the side towards +z
    builder.add(std::move(box), builder.material(glm::vec3(1.0F)));
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering =
            test::path_image(backend, builder.scene, test::look_at({0, 0, 2.5}, {0, 0, -1}, 0.7),
                             test::path_settings(24, 24, 256));
        for (std::uint32_t c = 0; c < 3; ++c)
            test::expect_estimate(test::beauty_of(rendering, c), at(radiance, c),
                                  {comparisons, 0.002, 1e-5}, name_of(backend, "bowl", c));
        EXPECT_GT(test::mean_of(rendering.layer("indirect")), 0.2);
    }
}

TEST(PathFurnace, IntegratingSphere) {
    // Two points of a sphere see each other alike wherever they are: a light of intensity I at the
    // centre gives E = I / R^2 directly and E rho / (1 - rho) by all bounces. Facets of level 5
    // reach 2.5e-4 R inside, which makes the sphere smaller by as much, twice in 1 / R^2.
    constexpr double facets = 1e-3;
    constexpr double radius = 2.5;
    const glm::dvec3 centre(3.0, -1.0, 7.0);
    const glm::vec3 albedo(0.9F, 0.5F, 0.1F);
    const glm::vec3 intensity(1.0F, pi, 3.0F);
    SceneBuilder builder;
    builder.add(test::icosphere(5, true), builder.material(albedo),
                test::placement(radius, centre));
    builder.light(LightType::point, centre, intensity);
    validate_scene(builder.scene);
    const FlatScene flat = flatten(builder.scene);
    const Camera camera = test::look_at(centre + radius * glm::dvec3(0.1, -0.2, 0.3),
                                        centre + radius * glm::dvec3(-0.5, 0.3, -0.8), 1.2);
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::path_image(test::shared_executor(backend), flat, camera,
                                                     test::path_settings(32, 32, 128, 2));
        for (std::uint32_t c = 0; c < 3; ++c) {
            const double rho = at(albedo, c);
            const double direct = rho / pi * at(intensity, c) / (radius * radius);
            for (const double value : test::channel_of(rendering, "direct", c))
                ASSERT_NEAR(value, direct, facets * direct);
            test::expect_estimate(test::beauty_of(rendering, c), direct / (1.0 - rho),
                                  {comparisons, 0.004, facets / (1.0 - rho)},
                                  name_of(backend, "sphere", c));
        }
    }
}

TEST(PathFurnace, ThePublishedSphereHasRadianceOne) {
    // rho = 1/2, I = pi, R = 1.
    SceneBuilder builder;
    builder.add(test::icosphere(5, true), builder.material(glm::vec3(0.5F)));
    builder.light(LightType::point, {0, 0, 0}, glm::vec3(std::numbers::pi_v<float>));
    const Rendering rendering = test::path_image(TestBackend::own_bvh, builder.scene, inside(),
                                                 test::path_settings(32, 32, 256, 3));
    test::expect_estimate(test::beauty_of(rendering, 0), 1.0, {comparisons, 0.002, 1e-3},
                          "published sphere");
}

TEST(PathFurnace, PlatesWithoutEnd) {
    // B1 = (e1 + rho1 e2) / (1 - rho1 rho2), but for light that leaves at the edges 500 gaps away:
    // 4e-6 of it.
    const glm::vec3 e1(1.0F, 0.2F, 0.0F);
    const glm::vec3 e2(0.3F, 1.0F, 2.0F);
    const glm::vec3 rho1(0.5F, 0.8F, 0.4F);
    const glm::vec3 rho2(0.7F, 0.3F, 0.9F);
    SceneBuilder builder;
    builder.add(test::quad_mesh({-500, -500, 0}, {1000, 0, 0}, {0, 1000, 0}),
                builder.material(rho1, e1));
    builder.add(test::quad_mesh({-500, -500, 1}, {0, 1000, 0}, {1000, 0, 0}),
                builder.material(rho2, e2));
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering =
            test::path_image(backend, builder.scene, test::look_at({0, 0, 0.6}, {0, 0, 0}, 1.0),
                             test::path_settings(24, 24, 256, 4));
        for (std::uint32_t c = 0; c < 3; ++c) {
            const double direct = at(rho1, c) * at(e2, c);
            const double all = (at(e1, c) + direct) / (1.0 - at(rho1, c) * at(rho2, c));
            test::expect_estimate(test::beauty_of(rendering, c), all, {comparisons, 0.004, 2e-5},
                                  name_of(backend, "plates", c));
            test::expect_estimate(test::layer_of(rendering, "direct", c), direct,
                                  {comparisons, 0.004, 2e-5},
                                  name_of(backend, "plates' direct light", c));
        }
    }
}

TEST(PathFurnace, TheVarianceIsThatOfThePixels) {
    // Pixels of the same expectation: the mean of the variances that the renderer estimates is the
    // variance between pixels. With 4096 of them that is known within 2.2 % (the standard error of
    // a sample variance of nearly normal values, sqrt(2 / 4096)); allowed are 5 of that.
    const glm::vec3 emission(1.0F, 2.0F, 0.5F);
    SceneBuilder builder;
    builder.add(test::icosphere(2, true), builder.material({0.5F, 0.8F, 0.7F}, emission));
    const Rendering rendering = test::path_image(TestBackend::own_bvh, builder.scene, inside(),
                                                 test::path_settings(64, 64, 32, 5));
    for (std::uint32_t c = 0; c < 3; ++c) {
        const double by_renderer = test::beauty_of(rendering, c).error;
        const double between = test::layer_of(rendering, "", c).error;
        EXPECT_NEAR(between * between / (by_renderer * by_renderer), 1.0, 5 * 0.0221) << c;
    }
}

}  // namespace
}  // namespace weft::path_furnace_test
