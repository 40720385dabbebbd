// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/testing/media_builder.h"
#include "tests/testing/path_fixture.h"
#include "tests/testing/scattered_light.h"
#include "tests/testing/smoky_room.h"

// Previews of scenes with participating media: light that media scatter to the camera, and what
// they leave of all other light, where it is known; media_slow_test.cpp has path tracing.
namespace weft::media_test {
namespace {

using test::add_boundary;
using test::at;
using test::cube_mesh;
using test::medium_of;
using test::Rendering;
using test::scattered_mean;
using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;

RenderSettings settings_of(Algorithm algorithm, std::uint32_t size) {
    return test::unbounded(test::small_settings(algorithm, size, size));
}

/// How a medium fills all that is seen: without a boundary, or in a cube that is far larger, with
/// segments from planes or from walks. All look the same.
enum class Space { endless, convex, walked };
constexpr std::array spaces{Space::endless, Space::convex, Space::walked};

SceneBuilder filled_space(const Medium& medium, Space space) {
    SceneBuilder builder;
    builder.scene.media.push_back(medium);
    if (space == Space::endless)
        builder.scene.outer_medium = 0;
    else
        add_boundary(builder.scene, cube_mesh(), test::placement(20.0, {0.0, 0.0, 0.0}), 0);
    if (space == Space::walked) test::add_far_overlap(builder.scene);
    return builder;
}

TEST(Media, AirlightOfAPointLight) {
    // Sun et al. 2005: beta = 0.3, I = 2, light 1.5 away at 0.9 rad from the ray, wall 4 away.
    constexpr double gamma = 0.9;
    for (const Space space : spaces) {
        SceneBuilder builder = filled_space(medium_of(glm::vec3(0.3F), glm::vec3(1.0F)), space);
        builder.add(test::quad_mesh({-0.1F, -0.1F, -4.0F}, {0.2F, 0.0F, 0.0F}, {0.0F, 0.2F, 0.0F}),
                    builder.material(glm::vec3(0.0F)));
        PunctualLight light;
        light.intensity = glm::vec3(2.0F, 1.0F, 4.0F);
        light.position = {1.5 * std::sin(gamma), 0.0, -1.5 * std::cos(gamma)};
        builder.scene.lights.push_back(light);
        RenderSettings settings = settings_of(Algorithm::amax, 16);
        settings.indirect = false;
        settings.sampling.bounces = 0;
        for (const TestBackend backend : test::light_backends()) {
            // 32 frames of 16 places for each of 9 sets: 4608 evenly spread places.
            const Rendering rendering =
                test::render(backend, builder.scene,
                             test::look_at({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 1e-4), settings, 32);
            for (std::uint32_t c = 0; c < 3; ++c) {
                const double expected = 0.03389058698 * at(light.intensity, c) / 2.0;
                for (const double value : test::channel_of(rendering, "media", c))
                    ASSERT_NEAR(value, expected, 1e-3 * expected) << test::backend_name(backend);
            }
        }
    }
}

TEST(Media, ALightOnTheViewRayIsFinite) {
    for (const Space space : spaces) {
        SceneBuilder builder = filled_space(medium_of(glm::vec3(0.3F), glm::vec3(1.0F)), space);
        PunctualLight light;
        light.position = {0.0, 0.0, -1.0};
        builder.scene.lights.push_back(light);
        for (const double angle : {1e-4, 1.0})
            for (const glm::dvec3& from : {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, -1.0)}) {
                const Rendering rendering = test::render(
                    TestBackend::own_bvh, builder.scene,
                    test::look_at(from, {0.0, 0.0, -2.0}, angle), settings_of(Algorithm::ais, 9));
                for (const float value : rendering.layer("media"))
                    ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
                EXPECT_GT(test::mean_of(rendering.layer("media")), 0.0);
            }
    }
}

TEST(Media, SurfacesAreSeenAndLitThroughMedia) {
    // A point light above a floor, all in a medium that absorbs: exactly known.
    const glm::vec3 sigma(0.2F, 1.0F, 3.0F);
    for (const Space space : spaces)
        for (const Algorithm algorithm : {Algorithm::igi, Algorithm::ais}) {
            SceneBuilder builder = filled_space(medium_of(sigma, glm::vec3(0.0F)), space);
            builder.add(
                test::quad_mesh({-1.0F, -1.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}),
                builder.material(glm::vec3(0.5F)));
            PunctualLight light;
            light.intensity = glm::vec3(3.0F);
            light.position = {0.3, 0.2, 0.0};
            builder.scene.lights.push_back(light);
            for (const TestBackend backend : test::light_backends()) {
                const Rendering rendering = test::render(
                    backend, builder.scene, test::look_at({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, 1e-4),
                    settings_of(algorithm, 8));
                EXPECT_EQ(rendering.image.find("media"), nullptr) << "nothing scatters";
                const double d = std::sqrt(0.09 + 1.44);
                for (std::uint32_t c = 0; c < 3; ++c)
                    for (const double value : test::channel_of(rendering, "direct", c)) {
                        const double expected = 0.5 / pi * 3.0 * (1.2 / d) / (d * d) *
                                                std::exp(-(1.0 + d) * at(sigma, c));
                        ASSERT_NEAR(value, expected, 2e-4 * expected);
                    }
            }
        }
}

TEST(Media, SlabsEmit) {
    // A slab of thickness 2 that emits, absorbs and scatters, in front of an emitting wall; nothing
    // else shines.
    const glm::vec3 sigma(0.25F, 1.0F, 3.0F);
    for (const bool gridded : {false, true}) {
        SceneBuilder builder;
        builder.scene.media.push_back(medium_of(sigma, glm::vec3(0.5F)));
        builder.scene.media[0].emission = {1.0F, 2.0F, 4.0F};
        const glm::dmat4 slab = glm::scale(glm::dmat4(1.0), glm::dvec3(50.0, 50.0, 1.0));
        if (gridded) {
            DensityGrid grid;
            grid.size = {2, 2, 2};
            grid.densities.assign(8, 1.0F);
            test::add_grid(builder.scene, 0, grid, slab);
            builder.scene.outer_medium = 0;
        } else {
            add_boundary(builder.scene, cube_mesh(), slab, 0);
        }
        builder.add(
            test::quad_mesh({-9.0F, -9.0F, -2.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 18.0F, 0.0F}),
            builder.material(glm::vec3(0.0F), glm::vec3(3.0F)));
        for (const TestBackend backend : test::light_backends()) {
            const Rendering rendering =
                test::render(backend, builder.scene, test::look_at({0, 0, 5}, {0, 0, -9}, 1e-4),
                             settings_of(Algorithm::ais, 8));
            for (std::uint32_t c = 0; c < 3; ++c) {
                const double s = at(sigma, c);
                const double expected =
                    3.0 * std::exp(-2.0 * s) +
                    at(builder.scene.media[0].emission, c) * -std::expm1(-2.0 * s) / s;
                for (const double value : test::channel_of(rendering, "emission", c))
                    ASSERT_NEAR(value, expected, 1e-5 * expected) << test::backend_name(backend);
            }
        }
    }
}

TEST(Media, SegmentsFromPlanesAreThoseOfWalks) {
    // A box in a box, and one apart, in a room that fog fills; a point light in the innermost.
    Scene convex = test::foggy_room().scene;
    convex.outer_medium = 0;
    convex.media.push_back(medium_of({2.0F, 0.5F, 1.0F}, {0.5F, 0.9F, 0.7F}, -0.3F));
    convex.media.push_back(medium_of(glm::vec3(4.0F), glm::vec3(0.9F)));
    add_boundary(convex, cube_mesh(), test::turned(0.5, {0.2, 0.0, -0.3}), 1);
    add_boundary(convex, cube_mesh(), test::placement(0.15, {0.35, 0.1, -0.3}), -1);
    add_boundary(convex, test::icosphere(0, false), test::placement(0.2, {-0.6, -0.5, 0.0}), 2);
    Scene walked = convex;
    test::add_far_overlap(walked);
    ASSERT_EQ(flatten(convex).media.space.convex, 1U);
    ASSERT_EQ(flatten(walked).media.space.convex, 0U);
    const RenderSettings settings = settings_of(Algorithm::amax, 32);
    for (const TestBackend backend : test::light_backends()) {
        const Rendering a = test::render(backend, convex, test::room_camera(), settings, 2);
        const Rendering b = test::render(backend, walked, test::room_camera(), settings, 2);
        for (const char* layer : {"direct", "indirect", "media"}) {
            const auto& expected = b.layer(layer);
            const double mean = test::mean_of(expected);
            ASSERT_GT(mean, 0.0);
            // Walks step over boundaries by roundings of the scene's size, a few 1e-6 of lengths
            // and so of depths; where VPLs are close that is a larger share of the distance.
            for (std::size_t i = 0; i < expected.size(); ++i)
                ASSERT_NEAR(a.layer(layer)[i], expected[i], 1e-4 * (mean + expected[i])) << layer;
        }
    }
}

TEST(Media, BoundariesMayShareFaces) {
    // A cube and, in the half of it that is further away, a box that shares five of its faces:
    // entered or left at the same place.
    for (const auto& [side, walked] :
         {std::pair(1.0, false), {-1.0, false}, {1.0, true}, {-1.0, true}}) {
        SceneBuilder builder;
        builder.scene.media.push_back(medium_of(glm::vec3(0.3F), glm::vec3(0.0F)));
        builder.scene.media.push_back(medium_of(glm::vec3(0.7F), glm::vec3(0.0F)));
        add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
        glm::dmat4 half = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, 0.5));
        half[3] = {0.0, 0.0, -0.5, 1.0};
        add_boundary(builder.scene, cube_mesh(), half, 1);
        if (walked) test::add_far_overlap(builder.scene);
        const auto z = static_cast<float>(-3.0 * side);
        builder.add(test::quad_mesh({-9.0F, -9.0F, z}, {18.0F, 0.0F, 0.0F}, {0.0F, 18.0F, 0.0F}),
                    builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
        builder.scene.materials.back().emission.both_sides = true;
        for (const TestBackend backend : test::light_backends()) {
            const Rendering rendering =
                test::render(backend, builder.scene,
                             test::look_at({0.2, 0.1, 5.0 * side}, {0.2, 0.1, -9.0 * side}, 0.05),
                             settings_of(Algorithm::igi, 8));
            // Rays at up to .035 rad from the axis go .06 % further.
            for (const double value : test::channel_of(rendering, "emission", 0))
                ASSERT_NEAR(value, std::exp(-1.0), 1e-3) << test::backend_name(backend) << side;
        }
    }
}

TEST(Media, SunlightInAnAbsorbingSlab) {
    // A directional light along the view, through a slab of thickness 2 in front of a wall.
    const glm::vec3 sigma(0.25F, 1.0F, 3.0F);
    SceneBuilder builder;
    builder.scene.media.push_back(medium_of(sigma, glm::vec3(0.6F)));
    add_boundary(builder.scene, cube_mesh(),
                 glm::scale(glm::dmat4(1.0), glm::dvec3(50.0, 50.0, 1.0)), 0);
    builder.add(test::quad_mesh({-9.0F, -9.0F, -2.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 18.0F, 0.0F}),
                builder.material(glm::vec3(0.5F)));
    PunctualLight sun;
    sun.type = LightType::directional;
    sun.direction = {0.0, 0.0, -1.0};
    sun.intensity = glm::vec3(2.0F);
    builder.scene.lights.push_back(sun);
    RenderSettings settings = settings_of(Algorithm::amax, 8);
    settings.sampling.bounces = 0;
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::render(
            backend, builder.scene, test::look_at({0, 0, 5}, {0, 0, -9}, 1e-4), settings, 64);
        for (std::uint32_t c = 0; c < 3; ++c) {
            const double s = at(sigma, c);
            const double wall = 0.5 / pi * 2.0 * std::exp(-4.0 * s);
            // Isotropic: the light goes in and out by the same way.
            const double slab = 2.0 * 0.6 / (4.0 * pi) * (1.0 - std::exp(-4.0 * s)) / 2.0;
            for (const double value : test::channel_of(rendering, "direct", c))
                ASSERT_NEAR(value, wall, 2e-4 * wall);
            // Places are spread evenly: 64 frames of 144 places.
            for (const double value : test::channel_of(rendering, "media", c))
                ASSERT_NEAR(value, slab, 2e-3 * slab) << test::backend_name(backend);
        }
    }
}

TEST(Media, AdaptiveWithoutThresholdIsPlainInterleavedSampling) {
    for (const Scene& scene : {test::smoky_room(), [] {
                                   Scene fog = test::foggy_room().scene;
                                   fog.outer_medium = 0;
                                   return fog;
                               }()})
        for (const TestBackend backend : test::light_backends()) {
            RenderSettings settings = test::small_settings(Algorithm::ais, 40, 30);
            settings.sampling.threshold = 0.0;
            const Rendering adaptive =
                test::render(backend, scene, test::room_camera(), settings, 2);
            settings.algorithm = Algorithm::amax;
            const Rendering full = test::render(backend, scene, test::room_camera(), settings, 2);
            for (const char* layer : {"", "direct", "indirect", "media"})
                EXPECT_EQ(adaptive.layer(layer), full.layer(layer)) << layer;
        }
}

TEST(Media, SameBitsForAllLanesThreadsAndBackends) {
    const Scene scene = test::smoky_room();
    const FlatScene flat = flatten(scene);
    const RenderSettings settings = test::small_settings(Algorithm::ais, 40, 30);
    const auto image = [&](Executor& executor) {
        return test::render_flat(executor, flat, test::room_camera(), settings, 2).image;
    };
    const Image reference = image(test::shared_executor(TestBackend::own_bvh));
    for (const std::uint32_t lanes : {1U, 4U, 8U, 16U}) {
        const auto executor = test::make_executor(TestBackend::own_bvh, lanes, 1);
        EXPECT_EQ(test::differing_values(image(*executor), reference), 0U) << lanes;
    }
    if (!test::has_opencl()) GTEST_SKIP() << "no OpenCL device";
    EXPECT_EQ(test::differing_values(image(test::shared_executor(TestBackend::opencl)), reference),
              0U);
}

TEST(Media, AConstantGridIsAHomogeneousMedium) {
    // By the scatter of ten seeds: the channel that scatters least differs by 2 % from one to the
    // next.
    constexpr std::uint32_t seeds = 10;
    Scene even = test::foggy_room().scene;
    add_boundary(even, cube_mesh(), glm::dmat4(0.8), 0);
    even.medium_boundaries.back().to_world[3][3] = 1.0;
    const auto means = [&](const Scene& scene) {
        std::array<std::vector<double>, 3> channels;
        RenderSettings settings = settings_of(Algorithm::igi, 24);
        settings.sampling.bounces = 0;
        for (settings.seed = 0; settings.seed < seeds; ++settings.seed) {
            const Rendering made =
                test::render(TestBackend::own_bvh, scene, test::room_camera(), settings, 16);
            for (std::uint32_t c = 0; c < 3; ++c) channels.at(c).push_back(scattered_mean(made, c));
        }
        return channels;
    };
    const auto homogeneous = means(even);
    // Ended by the grid itself, and by a boundary as well.
    for (const bool bounded : {false, true}) {
        Scene gridded = bounded ? even : test::foggy_room().scene;
        DensityGrid grid;
        grid.size = {4, 4, 4};
        grid.densities.assign(64, 1.0F);
        test::add_grid(gridded, 0, grid, test::placement(0.8, {0.0, 0.0, 0.0}));
        if (!bounded) gridded.outer_medium = 0;
        ASSERT_EQ(flatten(gridded).media.space.convex, bounded ? 1U : 0U);
        const auto found = means(gridded);
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = test::estimate(homogeneous.at(c)).mean;
            EXPECT_GT(expected, 0.01);
            test::expect_estimate(test::estimate(found.at(c)), expected, {6, 0.01, 1e-3},
                                  testing::PrintToString(c));
        }
    }
}

TEST(Media, HostileMediaStayFinite) {
    for (const float sigma : {1e-30F, 1e6F, 1e30F})
        for (const float g : {0.0F, 0.99999994F, -0.99999994F})
            for (const bool bounded : {false, true}) {
                Scene scene = test::foggy_room().scene;
                scene.media[0] = medium_of({sigma, 1.0F, 0.0F}, glm::vec3(0.9F), g);
                scene.lights[0].position = {0.0, 0.0, 0.0};
                if (bounded)
                    add_boundary(scene, cube_mesh(), glm::dmat4(1.0), 0);
                else
                    scene.outer_medium = 0;
                for (const glm::dvec3& from :
                     {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 0.0, 0.5)}) {
                    const Rendering rendering = test::render(
                        TestBackend::own_bvh, scene, test::look_at(from, {0.0, 0.0, 0.0}, 1.0),
                        test::small_settings(Algorithm::ais, 12, 9));
                    for (const Layer& layer : rendering.image.layers)
                        for (const float value : layer.values)
                            ASSERT_TRUE(std::isfinite(value)) << layer.name << " " << sigma;
                    for (const NonfiniteStats& stats : rendering.stats.back().nonfinite)
                        EXPECT_EQ(stats.count, 0U) << sigma << " g " << g;
                }
            }
}

}  // namespace
}  // namespace weft::media_test
