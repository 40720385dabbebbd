// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "selftest/statistics.h"
#include "tests/testing/density_grid_reference.h"
#include "tests/testing/media_builder.h"
#include "tests/testing/path_fixture.h"

// Path tracing with media and materials together: media inside of glass dim light by the way of
// refracted rays, what absorbs nothing is invisible in surroundings of its own radiance, and
// mirrored rays are in the medium that the mirror is in.
//
// The mean of an image is compared with its expectation by its standard error; the limit is that of
// 300 comparisons (sidak_limit: about 5.1 standard errors), more than this file makes.
namespace weft::path_media_surfaces_test {
namespace {

using test::add_boundary;
using test::at;
using test::cube_mesh;
using test::medium_of;
using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr std::size_t comparisons = 300;

std::uint32_t add_surface(SceneBuilder& builder, const SurfaceDescription& description) {
    const std::uint32_t number = builder.material(glm::vec3(0.5F));
    builder.scene.materials[number].description = description;
    return number;
}

SurfaceDescription glass(float alpha = 0.0F) {
    DielectricSurface surface;
    surface.ior_inside = 1.5;
    surface.ior_outside = 1.0;
    surface.roughness_u.value.factor = alpha;
    surface.roughness_v.value.factor = alpha;
    return {surface, {}, {}};
}

SurfaceDescription metal() {
    MetallicSurface surface;
    surface.base_colour.factor = glm::vec3(1.0F);
    surface.roughness.value.factor = 0.0F;
    return {surface, {}, {}};
}

SurfaceDescription sheet(float alpha) {
    LambertSurface surface;
    surface.colour.factor = glm::vec3(0.0F);
    SurfaceDescription description{surface, {}, {}};
    description.opacity.mode = OpacityMode::blend;
    description.opacity.alpha.factor = alpha;
    return description;
}

/// A solid of glass with a medium inside.
void add_filled(SceneBuilder& builder, const Mesh& mesh, const SurfaceDescription& surface,
                const glm::dmat4& to_world, int medium) {
    builder.add(mesh, add_surface(builder, surface), to_world);
    add_boundary(builder.scene, mesh, to_world, medium);
    builder.scene.medium_boundaries.back().surface =
        static_cast<int>(builder.scene.instances.size()) - 1;
}

void expect_mean(const Rendering& rendering, const glm::dvec3& expected, double largest_error,
                 const std::string& name) {
    for (std::uint32_t c = 0; c < 3; ++c)
        test::expect_estimate(test::beauty_of(rendering, c), expected[static_cast<int>(c)],
                              {comparisons, largest_error, 2e-5},
                              name + " channel " + std::to_string(c));
}

std::string on(TestBackend backend, const std::string& what) {
    return std::string(test::backend_name(backend)) + " " + what;
}

/// What glass of index 1.5 reflects from outside at that cosine.
double fresnel(double cosine) {
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / 2.25);
    const double s = (cosine - 1.5 * inside) / (cosine + 1.5 * inside);
    const double p = (1.5 * cosine - inside) / (1.5 * cosine + inside);
    return 0.5 * (s * s + p * p);
}

/// A wall of radiance 1 at z = -3, all else black.
SceneBuilder wall_scene() {
    SceneBuilder builder;
    builder.add(test::quad_mesh({-60, -60, -3}, {120, 0, 0}, {0, 120, 0}),
                builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    return builder;
}

TEST(PathMediaSurfaces, AbsorptionInGlassGoesByTheRefractedWay) {
    const glm::vec3 sigma(0.5F, 2.0F, 6.0F);
    constexpr double thickness = 0.2;
    for (const bool walked : {false, true})
        for (const double angle : {0.0, 0.8}) {
            SceneBuilder builder = wall_scene();
            builder.scene.media.push_back(medium_of(sigma, glm::vec3(0.0F)));
            add_filled(builder, cube_mesh(), glass(),
                       glm::scale(glm::dmat4(1.0), glm::dvec3(30.0, 30.0, 0.5 * thickness)), 0);
            if (walked) test::add_far_overlap(builder.scene);
            const double f = fresnel(std::cos(angle));
            const double sine = std::sin(angle) / 1.5;
            glm::dvec3 expected;
            for (std::uint32_t c = 0; c < 3; ++c) {
                const double a = std::exp(-at(sigma, c) * thickness / std::sqrt(1.0 - sine * sine));
                expected[static_cast<int>(c)] = a * (1 - f) * (1 - f) / (1 - a * a * f * f);
            }
            for (const TestBackend backend : test::light_backends())
                expect_mean(
                    test::path_image(backend, builder.scene,
                                     test::look_at({5 * std::sin(angle), 0, 5 * std::cos(angle)},
                                                   {0, 0, 0}, 1e-4),
                                     test::path_settings(16, 16, 256, 1)),
                    expected, 0.01,
                    on(backend, "slab at " + std::to_string(angle) + (walked ? " walked" : "")));
        }
}

TEST(PathMediaSurfaces, MirroredRaysStayInTheMediumBeforeTheMirror) {
    // Fog about a slab of glass that is full of ink: what the camera sees is the wall behind it,
    // mirrored, through the fog alone.
    constexpr double fog = 0.05;
    for (const bool walked : {false, true}) {
        SceneBuilder builder;
        builder.add(test::quad_mesh({60, -60, 8}, {-120, 0, 0}, {0, 120, 0}),
                    builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
        builder.scene.media.push_back(medium_of(glm::vec3(1e4F), glm::vec3(0.0F)));
        builder.scene.media.push_back(medium_of(glm::vec3(0.05F), glm::vec3(0.0F)));
        builder.scene.outer_medium = -1;
        add_filled(builder, cube_mesh(), glass(),
                   glm::scale(glm::dmat4(1.0), glm::dvec3(2.0, 2.0, 0.5)), 0);
        add_boundary(builder.scene, cube_mesh(), test::placement(10.0, {0, 0, 0}), 1);
        if (walked) test::add_far_overlap(builder.scene);
        const double expected = fresnel(1.0) * std::exp(-fog * (4.5 + 7.5));
        for (const TestBackend backend : test::light_backends())
            expect_mean(
                test::path_image(backend, builder.scene, test::look_at({0, 0, 5}, {0, 0, 0}, 1e-4),
                                 test::path_settings(16, 16, 512, 2)),
                glm::dvec3(expected), 0.02, on(backend, walked ? "walked" : "by planes"));
    }
}

/// Spheres of glass, full of white media, and a metal one, in white fog.
SceneBuilder white_things(bool grid) {
    SceneBuilder builder;
    builder.scene.media.push_back(medium_of({0.5F, 2.0F, 5.0F}, glm::vec3(1.0F), 0.3F));
    builder.scene.media.push_back(medium_of({0.2F, 0.1F, 0.4F}, glm::vec3(1.0F), -0.2F));
    if (grid)
        test::add_grid(builder.scene, 0,
                       make_grid({3, 4, 3}, [](auto i, auto, auto) { return i == 1 ? 1.0 : 0.4; }));
    add_filled(builder, test::icosphere(2, false), glass(), test::placement(0.5, {-0.6, 0, 0}), 0);
    // A mesh with normals inwards that the instance turns outwards, as readers make of it.
    add_filled(builder, test::icosphere(2, true), glass(0.3F), test::placement(0.4, {0.5, 0.3, 0}),
               -1);
    builder.scene.instances.back().flip_normals = true;
    builder.scene.medium_boundaries.back().exterior = 0;
    builder.add(test::icosphere(2, false), add_surface(builder, metal()),
                test::placement(0.3, {0.5, -0.5, 0.2}));
    add_boundary(builder.scene, cube_mesh(), test::placement(1.5, {0, 0, 0}), 1);
    return builder;
}

/// That nothing but what surrounds it is seen of a scene. Rough glass errs to loss by up to 0.5 %,
/// on a sixth of the image.
void expect_white(const Rendering& image, double largest_error, const std::string& name) {
    for (std::uint32_t c = 0; c < 3; ++c) {
        const test::Estimate found = test::beauty_of(image, c);
        EXPECT_LE(found.mean, 1.0 + 6.0 * found.error + 1e-5) << name;
        EXPECT_GE(found.mean, 0.997 - 6.0 * found.error) << name;
        EXPECT_LE(found.error, largest_error) << name;
    }
}

TEST(PathMediaSurfaces, WhiteMediaInGlassAreInvisibleInAFurnace) {
    for (const bool grid : {false, true}) {
        SceneBuilder builder = white_things(grid);
        builder.scene.environment = Environment{glm::vec3(1.0F)};
        for (const TestBackend backend : test::light_backends())
            for (const double distance : {4.0, 1.2})
                expect_white(test::path_image(backend, builder.scene,
                                              test::look_at({0, 0, distance}, {0, 0, 0}, 0.6),
                                              test::path_settings(16, 16, 128, 3)),
                             0.01, on(backend, grid ? "grids" : "media"));
    }
}

TEST(PathMediaSurfaces, LightSamplesAndScatteredRaysShareTheLightOfAShiningRoom) {
    // The walls shine and absorb: all light is found by light samples and by rays, weighted.
    SceneBuilder builder = white_things(false);
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.0F), glm::vec3(1.0F)),
                test::placement(3.0, {0, 0, 0}));
    for (const TestBackend backend : test::light_backends())
        expect_white(
            test::path_image(backend, builder.scene, test::look_at({0, 0, 2.9}, {0, 0, 0}, 0.8),
                             test::path_settings(16, 16, 128, 4)),
            0.02, on(backend, "room"));
}

TEST(PathMediaSurfaces, LightPassesSheetsAndFog) {
    // A lamp above a floor, a sheet between them that lets 0.7 pass, all in a medium that absorbs.
    const glm::vec3 sigma(0.2F, 1.0F, 3.0F);
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1.0F, -1.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}),
                builder.material(glm::vec3(0.5F)));
    builder.add(test::quad_mesh({-1.0F, 0.5F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}),
                add_surface(builder, sheet(0.3F)));
    builder.scene.media.push_back(medium_of(sigma, glm::vec3(0.0F)));
    add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
    builder.light(LightType::point, {0.3, 0.8, 0.0}, glm::vec3(3.0F));
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering = test::path_image(
            backend, builder.scene, test::look_at({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, 1e-4),
            test::path_settings(4, 4, 4));
        const double d = std::sqrt(0.09 + 3.24);
        for (std::uint32_t c = 0; c < 3; ++c)
            for (const double value : test::channel_of(rendering, "", c)) {
                const double expected = 0.7 * 0.5 / std::numbers::pi * 3.0 * (1.8 / d) / (d * d) *
                                        std::exp(-(1.0 + d) * at(sigma, c));
                ASSERT_NEAR(value, expected, 2e-4 * expected) << on(backend, "floor");
            }
    }
}

TEST(PathMediaSurfaces, MediaThatScatterInDiffuseScenesAreAsWithoutMaterials) {
    // The same light by the kernel for materials, which a metal far away asks for.
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.6F, 0.5F, 0.3F}));
    builder.add(test::quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0, 0}, {0, 0, 0.4F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    builder.scene.media.push_back(medium_of({0.3F, 1.0F, 2.0F}, {0.9F, 0.8F, 0.7F}, 0.5F));
    add_boundary(builder.scene, cube_mesh(), test::placement(0.9, {0, 0, 0}), 0);
    SceneBuilder with = builder;
    with.add(test::quad_mesh({4, 4, 4}, {0.1F, 0, 0}, {0, 0.1F, 0}), add_surface(with, metal()));
    const Camera camera = test::look_at({0.1, 0.2, 0.9}, {0.0, -0.2, 0.0}, 1.2);
    const PathSettings settings = test::path_settings(16, 16, 256, 5);
    const Rendering a = test::path_image(TestBackend::own_bvh, builder.scene, camera, settings);
    const Rendering b = test::path_image(TestBackend::own_bvh, with.scene, camera, settings);
    for (const char* const layer : {"direct", "indirect"})
        for (std::uint32_t c = 0; c < 3; ++c) {
            // Pixel by pixel, since the light varies over the image more than its noise.
            const std::vector<double> first = test::channel_of(a, layer, c);
            std::vector<double> ratio = test::channel_of(b, layer, c);
            const double mean = selftest::estimate(first).mean;
            for (std::size_t i = 0; i < ratio.size(); ++i)
                ratio[i] = 1 + (ratio[i] - first[i]) / mean;
            test::expect_estimate(selftest::estimate(ratio), 1.0, {comparisons, 0.02, 1e-5}, layer);
        }
}

TEST(PathMediaSurfaces, SameBitsOnAllBackendsAndInParts) {
    SceneBuilder builder = white_things(true);
    builder.add(test::room_mesh(), builder.material({0.6F, 0.5F, 0.4F}),
                test::placement(2.0, {0, 0, 0}));
    builder.add(test::quad_mesh({-0.5F, 1.8F, -0.5F}, {1, 0, 0}, {0, 0, 1}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    builder.add(test::quad_mesh({-0.5F, -0.5F, 1.0F}, {1, 0, 0}, {0, 0.5F, 0}),
                add_surface(builder, sheet(0.5F)));
    const FlatScene flat = flatten(builder.scene);
    const Camera camera = test::look_at({0, 0, 1.9}, {0, -0.2, -1}, 1.2);
    const auto sums = [&](TestBackend backend, std::uint32_t first, std::uint32_t end) {
        PathSettings settings = test::path_settings(24, 24, end, 6);
        settings.samples = {first, end};
        return test::path_sums(test::shared_executor(backend), flat, camera, settings);
    };
    const FilmSums whole = sums(TestBackend::own_bvh, 0, 8);
    FilmSums parts = sums(TestBackend::own_bvh, 0, 3);
    add_sums(parts, sums(TestBackend::own_bvh, 3, 8));
    test::expect_same_sums(whole, parts);
    for (const TestBackend backend : test::backends())
        test::expect_same_sums(whole, sums(backend, 0, 8));
}

}  // namespace
}  // namespace weft::path_media_surfaces_test
