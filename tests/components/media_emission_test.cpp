// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/testing/smoky_room.h"

// Light that media emit, path traced: scenes without another light, where theirs is known.
//
// Comparisons by chance allow what sidak_limit gives for 300 of them (about 5.1 standard errors),
// more than this file makes; seeds are fixed, and standard errors are bounded. What reaches the
// camera unscattered from what it sees first is not a matter of chance.
namespace weft::media_emission_test {
namespace {

using test::add_boundary;
using test::add_grid;
using test::at;
using test::cube_mesh;
using test::medium_of;
using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;
using test::Tolerance;

constexpr std::size_t comparisons = 300;
const glm::vec3 colour(1.0F, 2.0F, 0.5F);

Medium emissive_medium(const glm::vec3& sigma_t, const glm::vec3& albedo, const glm::vec3& emission,
                       float g = 0.0F) {
    Medium medium = medium_of(sigma_t, albedo, g);
    medium.emission = emission;
    return medium;
}

/// A medium in thermal equilibrium with light of this radiance.
Medium grey_body(const glm::vec3& sigma_t, const glm::vec3& albedo, const glm::vec3& radiance,
                 float g = 0.0F) {
    return emissive_medium(sigma_t, albedo, sigma_t * (glm::vec3(1.0F) - albedo) * radiance, g);
}

/// Radiance of a slab of this emission and extinction.
double slab(double emission, double sigma, double length) {
    return sigma > 0.0 ? emission * -std::expm1(-sigma * length) / sigma : emission * length;
}

/// An image of what lies along -z from (0, 0, `from`), which is the same at all pixels.
Rendering along_axis(TestBackend backend, const Scene& scene, double from, std::uint32_t edge = 4,
                     std::uint32_t samples = 4) {
    return test::path_image(backend, scene, test::look_at({0, 0, from}, {0, 0, -9}, 1e-4),
                            test::path_settings(edge, edge, samples));
}

/// That every pixel of a layer has this value.
void expect_exactly(const Rendering& rendering, const std::string& layer, std::uint32_t channel,
                    double expected, double error, const std::string& what) {
    for (const double value : test::channel_of(rendering, layer, channel))
        ASSERT_NEAR(value, expected, error * expected)
            << what << " channel " << channel << ", relative error " << value / expected - 1.0;
}

TEST(MediaEmission, SlabsHaveTheirClosedForm) {
    for (const double depth : {0.0, 1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3})
        for (const float albedo : {0.0F, 0.8F})
            for (const double from : {3.0, 0.0}) {
                const double length = from > 1.0 ? 2.0 : 1.0;
                const auto unit = static_cast<float>(depth / length);
                const glm::vec3 sigma(unit, 3.0F * unit, 0.0F);
                SceneBuilder builder;
                builder.scene.media.push_back(emissive_medium(sigma, glm::vec3(albedo), colour));
                add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
                for (const TestBackend backend : test::light_backends()) {
                    const Rendering rendering = along_axis(backend, builder.scene, from);
                    for (std::uint32_t c = 0; c < 3; ++c)
                        expect_exactly(rendering, "emission", c,
                                       slab(at(colour, c), at(sigma, c), length), 1e-6,
                                       std::string(test::backend_name(backend)) + " depth " +
                                           std::to_string(depth));
                }
            }
}

TEST(MediaEmission, IsOfAnyBrightnessAndScale) {
    for (const double size : {1e-6, 1e6})
        for (const float brightness : {1e-10F, 1e10F}) {
            SceneBuilder builder;
            const auto sigma = static_cast<float>(1.0 / size);
            builder.scene.media.push_back(
                emissive_medium(glm::vec3(sigma), glm::vec3(0.0F), brightness * colour));
            add_boundary(builder.scene, cube_mesh(), test::placement(size, {0, 0, 0}), 0);
            const Rendering rendering =
                test::path_image(TestBackend::own_bvh, builder.scene,
                                 test::look_at({0, 0, 2.0 * size}, {0, 0, -size}, 1e-4),
                                 test::path_settings(4, 4, 4));
            for (std::uint32_t c = 0; c < 3; ++c)
                expect_exactly(rendering, "", c,
                               slab(static_cast<double>(brightness * colour[static_cast<int>(c)]),
                                    static_cast<double>(sigma), 2.0 * size),
                               2e-6, "size " + std::to_string(size));
        }
}

TEST(MediaEmission, IsSeenThroughMedia) {
    // A slab of 2 in front of one of 1, and an area light behind both. The first one only absorbs,
    // or scatters, where free paths of one channel decide what is left of all.
    const glm::vec3 sigma(0.25F, 1.0F, 2.0F);
    for (const float albedo : {0.0F, 0.9F}) {
        SceneBuilder builder;
        builder.add(
            test::quad_mesh({-9.0F, -9.0F, -4.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 18.0F, 0.0F}),
            builder.material(glm::vec3(0.0F), glm::vec3(0.3F)));
        builder.scene.media.push_back(emissive_medium(sigma, glm::vec3(albedo), colour));
        builder.scene.media.push_back(
            emissive_medium({1.0F, 0.0F, 0.2F}, glm::vec3(0.0F), {3, 2, 1}));
        add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
        add_boundary(builder.scene, cube_mesh(), test::placement(0.5, {0.0, 0.0, -2.0}), 1);
        const glm::vec3& second = builder.scene.media[1].sigma_t;
        for (const TestBackend backend : test::light_backends()) {
            const Rendering rendering = along_axis(backend, builder.scene, 3.0, 16, 64);
            for (std::uint32_t c = 0; c < 3; ++c) {
                const double behind = slab(3.0 - c, at(second, c), 1.0) +
                                      std::exp(-at(second, c)) * static_cast<double>(0.3F);
                const double expected =
                    slab(at(colour, c), at(sigma, c), 2.0) + std::exp(-2.0 * at(sigma, c)) * behind;
                if (albedo > 0.0F)
                    test::expect_estimate(test::layer_of(rendering, "emission", c), expected,
                                          Tolerance{comparisons, 0.02, 1e-5},
                                          test::backend_name(backend));
                else
                    expect_exactly(rendering, "", c, expected, 3e-6, test::backend_name(backend));
            }
        }
    }
}

TEST(MediaEmission, FloorsInFogWithoutEnd) {
    // What the floor reflects comes from fog as deep as it gets; the camera is 0.8 above.
    const glm::vec3 sigma(0.2F, 1.0F, 3.0F);
    const glm::vec3 albedo(0.5F, 0.25F, 0.75F);
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1.0F, -1.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}),
                builder.material(albedo));
    builder.scene.media.push_back(grey_body(sigma, glm::vec3(0.0F), colour));
    builder.scene.outer_medium = 0;
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::path_image(
            backend, builder.scene, test::look_at({0.0, -0.2, 0.0}, {0.0, -1.0, 0.0}, 1e-4),
            test::path_settings(4, 4, 4));
        for (std::uint32_t c = 0; c < 3; ++c) {
            const double left = std::exp(-0.8 * at(sigma, c));
            expect_exactly(rendering, "emission", c, at(colour, c) * (1.0 - left), 3e-6,
                           test::backend_name(backend));
            expect_exactly(rendering, "direct", c, at(albedo, c) * at(colour, c) * left, 3e-6,
                           test::backend_name(backend));
        }
    }
}

TEST(MediaEmission, LightsFloors) {
    // A wide slab of thickness 1 above a floor: radiance B (1 - 2 E3(sigma)) times the albedo.
    const glm::vec3 sigma(0.2F, 1.0F, 4.0F);
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1.0F, -1.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}),
                builder.material(glm::vec3(0.5F)));
    builder.scene.media.push_back(grey_body(sigma, glm::vec3(0.0F), colour));
    add_boundary(builder.scene, cube_mesh(),
                 glm::scale(glm::translate(glm::dmat4(1.0), {0.0, 0.5, 0.0}), {200.0, 0.5, 200.0}),
                 0);
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::path_image(
            backend, builder.scene, test::look_at({0.0, -0.5, 0.0}, {0.0, -1.0, 0.0}, 1e-4),
            test::path_settings(16, 16, 64));
        for (std::uint32_t c = 0; c < 3; ++c) {
            constexpr int steps = 20000;
            double sum = 0.0;
            for (int i = 0; i < steps; ++i) {
                const double cosine = (i + 0.5) / steps;
                sum += 2.0 * cosine * -std::expm1(-at(sigma, c) / cosine) / steps;
            }
            test::expect_estimate(test::layer_of(rendering, "direct", c), 0.5 * at(colour, c) * sum,
                                  Tolerance{comparisons, 0.01, 1e-4}, test::backend_name(backend));
        }
    }
}

TEST(MediaEmission, GreyBodiesVanish) {
    // Fog without end, even fog and smoke in boxes, and a ball, all as bright as what is around
    // them: nothing can be told from anything else.
    SceneBuilder builder;
    builder.add(test::icosphere(1, false), builder.material(glm::vec3(0.7F), 0.3F * colour),
                test::placement(0.5, {0.1, 0.0, 0.0}));
    builder.scene.media.push_back(grey_body({0.5F, 1.0F, 2.0F}, {0.5F, 0.8F, 0.2F}, colour, 0.3F));
    builder.scene.media.push_back(grey_body({3.0F, 1.0F, 0.0F}, {0.7F, 0.0F, 0.5F}, colour, -0.4F));
    builder.scene.media.push_back(grey_body({4.0F, 8.0F, 2.0F}, {0.9F, 0.5F, 0.7F}, colour));
    builder.scene.media.push_back(grey_body({4.0F, 0.0F, 2.0F}, glm::vec3(0.0F), colour));
    builder.scene.outer_medium = 0;
    add_boundary(builder.scene, cube_mesh(), test::placement(0.4, {-0.6, 0.3, 0.2}), 1);
    add_boundary(builder.scene, cube_mesh(), test::placement(0.5, {0.6, -0.3, 0.4}), 2);
    add_boundary(builder.scene, cube_mesh(), test::placement(0.4, {0.3, 0.5, 0.33}), 3);
    add_grid(builder.scene, 2, test::patchy_grid(), test::turned(0.6, {0.6, -0.3, 0.4}));
    add_grid(builder.scene, 3, test::patchy_grid(), test::turned(0.5, {0.3, 0.5, 0.3}));
    for (const TestBackend backend : test::light_backends())
        for (const double distance : {3.0, 0.8}) {
            const Rendering rendering = test::path_image(
                backend, builder.scene, test::look_at({0.3, 0.17, distance}, {0.1, 0.0, 0.0}, 1.0),
                test::path_settings(24, 24, 64));
            for (std::uint32_t c = 0; c < 3; ++c)
                test::expect_estimate(
                    test::beauty_of(rendering, c), at(colour, c),
                    Tolerance{comparisons, 0.01, 1e-5},
                    std::string(test::backend_name(backend)) + " channel " + std::to_string(c));
        }
}

/// A room without an area light, and fog that emits in a box.
Scene emissive_room() {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.7F, 0.5F, 0.3F}));
    builder.scene.media.push_back(
        emissive_medium({0.5F, 1.0F, 3.0F}, {0.9F, 0.8F, 0.7F}, {1.0F, 2.0F, 4.0F}, 0.5F));
    return builder.scene;
}

const glm::dmat4 fog_box = test::placement(0.6, {0.0, 0.1, -0.2});

TEST(MediaEmission, ConstantGridsAreHomogeneousMedia) {
    Scene even = emissive_room();
    add_boundary(even, cube_mesh(), fog_box, 0);
    Scene grid = emissive_room();
    grid.media[0].sigma_t *= 0.25F;
    grid.media[0].emission *= 0.25F;
    add_grid(grid, 0, make_grid({9, 6, 7}, [](auto, auto, auto) { return 4.0; }), fog_box);
    grid.outer_medium = 0;
    for (const TestBackend backend : test::light_backends()) {
        const Rendering expected = test::path_image(backend, even, test::room_camera(),
                                                    test::path_settings(24, 24, 128, 1));
        const Rendering found = test::path_image(backend, grid, test::room_camera(),
                                                 test::path_settings(24, 24, 128, 2));
        for (std::uint32_t c = 0; c < 3; ++c) {
            const test::Estimate a = test::beauty_of(found, c);
            const test::Estimate b = test::beauty_of(expected, c);
            test::expect_estimate({a.mean, std::hypot(a.error, b.error)}, b.mean,
                                  Tolerance{comparisons, 0.01, 1e-5}, test::backend_name(backend));
        }
    }
}

TEST(MediaEmission, LinearSlabsHaveTheirClosedForm) {
    // Density 1 + z in [-1,1]^3, but constant within half a voxel of the faces; seen through the
    // whole of it and from its middle. The last one is opaque before its end.
    const auto depth_from = [](double z) {
        const double edge = 1.0 / 64.0;
        const double inner = std::clamp(z + 1.0, edge, 2.0 - edge);
        return edge * std::min(z + 1.0, edge) + 0.5 * (inner * inner - edge * edge) +
               (2.0 - edge) * std::max(0.0, z - 1.0 + edge);
    };
    for (const glm::vec3& sigma : {glm::vec3(0.25F, 1.0F, 0.0F), glm::vec3(1e-8F, 1e-4F, 20.0F),
                                   glm::vec3(2e3F, 3e3F, 1e5F)})
        for (const float albedo : {0.0F, 0.8F})
            for (const double from : {3.0, 0.25}) {
                SceneBuilder builder;
                builder.scene.media.push_back(emissive_medium(sigma, glm::vec3(albedo), colour));
                add_grid(builder.scene, 0, make_grid({2, 3, 64}, [](auto, auto, std::uint32_t k) {
                             return 2.0 * (k + 0.5) / 64;
                         }));
                builder.scene.outer_medium = 0;
                const double depth = depth_from(std::min(from, 1.0));
                for (const TestBackend backend : test::light_backends()) {
                    const Rendering rendering = along_axis(backend, builder.scene, from);
                    for (std::uint32_t c = 0; c < 3; ++c)
                        expect_exactly(rendering, "emission", c,
                                       slab(at(colour, c), at(sigma, c), depth), 1e-5,
                                       test::backend_name(backend));
                }
            }
}

/// Emissive fog in a box of a room, and fire about it.
Scene fiery_room() {
    Scene scene = emissive_room();
    add_boundary(scene, cube_mesh(), fog_box, 0);
    scene.media.push_back(
        emissive_medium({5.0F, 3.0F, 1.0F}, {0.5F, 0.9F, 0.0F}, {9.0F, 3.0F, 1.0F}, -0.3F));
    add_grid(scene, 1, test::patchy_grid(), test::turned(0.9, {0.0, 0.1, 0.0}));
    scene.outer_medium = 1;
    return scene;
}

TEST(MediaEmission, SameBitsOnDevicesAndInParts) {
    const FlatScene flat = flatten(fiery_room());
    const PathSettings settings = test::path_settings(24, 16, 8);
    Executor& own = test::shared_executor(TestBackend::own_bvh);
    const FilmSums whole = test::path_sums(own, flat, test::room_camera(), settings);
    PathSettings half = settings;
    half.samples = {0, 3};
    const FilmSums first = test::path_sums(own, flat, test::room_camera(), half);
    half.samples = {3, 8};
    EXPECT_EQ(test::path_sums(own, flat, test::room_camera(), half, first).words, whole.words);
    if (!test::has_opencl()) GTEST_SKIP() << "no OpenCL device";
    EXPECT_EQ(test::path_sums(test::shared_executor(TestBackend::opencl), flat, test::room_camera(),
                              settings)
                  .words,
              whole.words);
}

TEST(MediaEmission, HostileMediaStayFinite) {
    // Enormous and tiny emission and extinction, densities of all magnitudes, a boundary that is
    // open. path_sums expects every value to be finite.
    const std::vector<double> values = {0.0, 3e38, 1e-45, 1.0, 1e30};
    for (const float sigma : {0.0F, 1e-30F, 1e30F})
        for (const float emission : {1e-38F, 1e30F, 3e38F}) {
            Scene scene = fiery_room();
            for (Medium& medium : scene.media) {
                medium.sigma_t = {sigma, 1.0F, 1e38F};
                medium.emission = {emission, 0.0F, emission};
            }
            scene.grids[0] =
                make_grid({9, 5, 7}, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
                    return values[(i + j + k) % values.size()];
                });
            scene.meshes[scene.medium_boundaries[0].mesh].triangles.resize(7);
            for (const bool surfaces : {true, false}) {
                if (!surfaces) scene.instances.clear();
                for (const glm::dvec3& from : {test::room_eye, glm::dvec3(0.0, 0.1, 0.0)})
                    (void)test::path_image(TestBackend::own_bvh, scene,
                                           test::look_at(from, {0.0, 0.0, -0.5}, 1.0),
                                           test::path_settings(9, 9, 8));
            }
        }
}

}  // namespace
}  // namespace weft::media_emission_test
