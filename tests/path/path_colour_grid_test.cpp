// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "tests/testing/density_grid_reference.h"
#include "tests/testing/media_builder.h"
#include "tests/testing/path_fixture.h"

// Path tracing of media whose extinction has a colour that varies, or whose
// albedo varies: against homogeneous media and closed forms.
//
// Comparisons allow what sidak_limit gives for 200 of them (about 5 standard
// errors), more than this file makes; seeds are fixed, and standard errors are
// bounded.
namespace weft::path_colour_grid_test {
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

constexpr double pi = std::numbers::pi;
constexpr std::size_t comparisons = 200;
const glm::vec3 densities(0.2F, 1.0F, 3.0F);

/// A grid of three channels that are the same everywhere, but for one voxel far
/// from all rays that has `spike`: with a large one almost no tentative
/// collision is real.
DensityGrid colour_grid(float spike = 0.0F) {
    DensityGrid grid;
    grid.size = {8, 8, 8};
    grid.channels = 3;
    for (std::uint32_t c = 0; c < 3; ++c)
        for (std::uint32_t i = 0; i < 512; ++i)
            grid.densities.push_back(
                spike > 0.0F && i == (7 * 8 + 1) * 8 + 7 ? spike : densities[static_cast<int>(c)]);
    return grid;
}

/// Gives a medium a grid of albedos in the cube [-1,1]^3.
void add_albedo(Scene& scene, std::size_t medium, DensityGrid grid) {
    glm::dmat4 cube(2.0);
    cube[3] = {-1.0, -1.0, -1.0, 1.0};
    scene.media[medium].albedo_grid = static_cast<int>(scene.grids.size());
    scene.media[medium].albedo_to_world = cube;
    scene.grids.push_back(std::move(grid));
}

SceneBuilder lit_room() {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.6F, 0.5F, 0.3F}));
    builder.add(test::quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.4F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    builder.light(LightType::point, {0.4, 0.1, -0.3}, glm::vec3(1.0F));
    builder.scene.media.push_back(medium_of({0.3F, 1.0F, 2.0F}, {0.9F, 0.8F, 0.7F}, 0.5F));
    add_boundary(builder.scene, cube_mesh(), test::placement(0.9, {0, 0, 0}), 0);
    return builder;
}

const Camera room_view = test::look_at({0.1, 0.2, 0.9}, {0.0, -0.2, 0.0}, 1.2);

TEST(PathColourGrid, AConstantGridOfAlbedosIsAConstantAlbedo) {
    const SceneBuilder plain = lit_room();
    for (const std::uint32_t channels : {1U, 3U}) {
        SceneBuilder with = plain;
        SceneBuilder without = plain;
        if (channels == 1)
            without.scene.media[0].albedo = with.scene.media[0].albedo = glm::vec3(0.8F);
        DensityGrid grid;
        grid.size = {2, 3, 2};
        grid.channels = channels;
        for (std::uint32_t c = 0; c < channels; ++c)
            grid.densities.insert(grid.densities.end(), 12,
                                  without.scene.media[0].albedo[static_cast<int>(c)]);
        add_albedo(with.scene, 0, grid);
        with.scene.media[0].albedo = glm::vec3(0.1F);
        for (const TestBackend backend : test::light_backends()) {
            const auto words = [&](const Scene& scene) {
                return test::path_sums(test::shared_executor(backend), flatten(scene), room_view,
                                       test::path_settings(16, 16, 8, 1))
                    .words;
            };
            EXPECT_EQ(words(with.scene), words(without.scene))
                << test::backend_name(backend) << " " << channels << " channels";
        }
    }
}

TEST(PathColourGrid, AlbedosAreThoseOfThePlace) {
    // White below y = 0 and black above, in space without light but from above:
    // single scattering comes from below alone. The mean of both albedos
    // everywhere would give another image.
    SceneBuilder builder;
    builder.scene.environment = Environment{glm::vec3(1.0F)};
    builder.scene.media.push_back(medium_of(glm::vec3(1.0F), glm::vec3(0.5F)));
    add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
    add_albedo(builder.scene, 0,
               make_grid({1, 64, 1}, [](auto, auto j, auto) { return j < 32 ? 1.0 : 0.0; }));
    for (const TestBackend backend : test::light_backends()) {
        // Along y from above, the first half of the way absorbs only: the black
        // part is exact.
        PathSettings settings = test::path_settings(16, 16, 64, 2);
        const Rendering image =
            test::path_image(backend, builder.scene,
                             test::look_at({0.0, 5.0, 0.0}, {0.0, 0.0, 0.0}, 1e-3), settings);
        // What passes unscattered is the emission, and light that is scattered
        // below comes up through the black half again: less than all of it.
        for (std::uint32_t c = 0; c < 3; ++c) {
            test::expect_estimate(test::layer_of(image, "emission", c), std::exp(-2.0),
                                  Tolerance{comparisons, 0.05, 2e-3}, test::backend_name(backend));
            const double beauty = test::beauty_of(image, c).mean;
            EXPECT_GT(beauty, std::exp(-2.0) * 1.05);
            EXPECT_LT(beauty, std::exp(-1.0));
        }
    }
}

TEST(PathColourGrid, ConstantColoursAreHomogeneousMedia) {
    SceneBuilder plain = lit_room();
    // Near a lamp without size the light in a medium has no bound.
    plain.scene.lights.clear();
    plain.scene.media[0].sigma_t = densities;
    SceneBuilder with = plain;
    with.scene.media[0].sigma_t = glm::vec3(1.0F);
    add_grid(with.scene, 0, colour_grid());
    for (const TestBackend backend : test::light_backends()) {
        const PathSettings settings = test::path_settings(16, 16, 256, 3);
        const Rendering a = test::path_image(backend, plain.scene, room_view, settings);
        const Rendering b = test::path_image(backend, with.scene, room_view, settings);
        for (const char* const layer : {"emission", "direct", "indirect"})
            for (std::uint32_t c = 0; c < 3; ++c) {
                const test::Estimate first = test::layer_of(a, layer, c);
                const test::Estimate second = test::layer_of(b, layer, c);
                if (!(second.mean > 0.0)) continue;
                test::expect_estimate(
                    {first.mean, std::hypot(first.error, second.error)}, second.mean,
                    Tolerance{comparisons, 0.1, 1e-5},
                    std::string(test::backend_name(backend)) + " " + layer + std::to_string(c));
            }
    }
}

TEST(PathColourGrid, SlabsLeaveTheirTransmittanceInEachChannel) {
    for (const float spike : {0.0F, 2000.0F})
        for (const float albedo : {0.0F, 0.9F}) {
            SceneBuilder builder;
            builder.add(
                test::quad_mesh({-9.0F, -9.0F, -2.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 18.0F, 0.0F}),
                builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
            builder.scene.media.push_back(medium_of(glm::vec3(1.0F), glm::vec3(albedo)));
            add_grid(builder.scene, 0, colour_grid(spike));
            add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
            for (const TestBackend backend : test::light_backends()) {
                // Not through voxels next to the spike, but through its block.
                const Rendering rendering =
                    test::path_image(backend, builder.scene,
                                     test::look_at({0.1, -0.7, 3.0}, {0.1, -0.7, -9.0}, 1e-4),
                                     test::path_settings(16, 16, 64, 4));
                for (std::uint32_t c = 0; c < 3; ++c)
                    test::expect_shine(rendering, c, std::exp(-2.0 * at(densities, c)),
                                       albedo > 0.0F, Tolerance{comparisons, 0.25, 1e-4}, 2e-5,
                                       test::backend_name(backend));
            }
        }
}

TEST(PathColourGrid, SurfacesAreLitThroughColours) {
    for (const float spike : {0.0F, 2000.0F}) {
        SceneBuilder builder;
        builder.add(test::quad_mesh({-1.0F, -1.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}),
                    builder.material(glm::vec3(0.5F)));
        builder.scene.media.push_back(medium_of(glm::vec3(1.0F), glm::vec3(0.0F)));
        add_grid(builder.scene, 0, colour_grid(spike));
        add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
        builder.light(LightType::point, {0.3, 0.2, 0.1}, glm::vec3(3.0F));
        for (const TestBackend backend : test::light_backends()) {
            const Rendering rendering = test::path_image(
                backend, builder.scene, test::look_at({0.0, 0.0, 0.1}, {0.0, -1.0, 0.1}, 1e-4),
                test::path_settings(16, 16, 64, 5));
            const double d = std::sqrt(0.09 + 1.44);
            for (std::uint32_t c = 0; c < 3; ++c)
                test::expect_estimate(
                    test::beauty_of(rendering, c),
                    0.5 / pi * 3.0 * (1.2 / d) / (d * d) * std::exp(-(1.0 + d) * at(densities, c)),
                    Tolerance{comparisons, 0.05, 2e-4}, test::backend_name(backend));
        }
    }
}

TEST(PathColourGrid, WhiteColoursVanishInTheirSurroundings) {
    SceneBuilder builder;
    builder.scene.environment = Environment{{1.0F, 2.0F, 0.5F}};
    builder.scene.media.push_back(medium_of(glm::vec3(1.0F), glm::vec3(1.0F), 0.4F));
    DensityGrid patches;
    patches.size = {5, 4, 6};
    patches.channels = 3;
    for (std::uint32_t i = 0; i < 360; ++i)
        patches.densities.push_back(static_cast<float>(i * 7 % 11) * 0.3F);
    add_grid(builder.scene, 0, patches);
    add_boundary(builder.scene, test::icosphere(1, false), glm::dmat4(1.0), 0);
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering =
            test::path_image(backend, builder.scene, test::look_at({0, 0.1, 3}, {0.1, 0, -1}, 0.5),
                             test::path_settings(24, 24, 64, 6));
        for (std::uint32_t c = 0; c < 3; ++c)
            test::expect_estimate(test::beauty_of(rendering, c),
                                  at(builder.scene.environment->radiance, c),
                                  Tolerance{comparisons, 0.02, 1e-5}, test::backend_name(backend));
    }
}

TEST(PathColourGrid, SameBitsOnAllBackends) {
    SceneBuilder builder = lit_room();
    builder.scene.media[0].sigma_t = glm::vec3(1.0F);
    add_grid(builder.scene, 0, colour_grid(30.0F));
    DensityGrid albedo = colour_grid();
    for (float& value : albedo.densities) value *= 0.3F;
    add_albedo(builder.scene, 0, albedo);
    const FlatScene flat = flatten(builder.scene);
    const auto sums = [&](TestBackend backend) {
        return test::path_sums(test::shared_executor(backend), flat, room_view,
                               test::path_settings(24, 16, 8, 7));
    };
    const FilmSums own = sums(TestBackend::own_bvh);
    for (const TestBackend backend : test::backends()) test::expect_same_sums(own, sums(backend));
}

}  // namespace
}  // namespace weft::path_colour_grid_test
