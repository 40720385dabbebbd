// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/testing/path_fixture.h"

// Path tracing with metals, plastics and glass: in surroundings of radiance 1 what absorbs nothing
// is invisible, and slabs, lamps in glass, sheets and mirrors have the radiance of closed forms.
//
// The mean of an image is compared with its expectation by its standard error; the limit is that of
// 200 comparisons (sidak_limit: about 5 standard errors), more than this file makes.
namespace weft::path_surfaces_test {
namespace {

using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;
using test::Tolerance;

constexpr std::size_t comparisons = 200;

std::uint32_t add_surface(SceneBuilder& builder, const SurfaceDescription& description,
                          const glm::vec3& emission = glm::vec3(0.0F)) {
    const std::uint32_t number = builder.material(glm::vec3(0.5F), emission);
    builder.scene.materials[number].description = description;
    return number;
}

SurfaceDescription metal(float roughness, const glm::vec3& colour = glm::vec3(1.0F)) {
    MetallicSurface surface;
    surface.base_colour.factor = colour;
    surface.roughness.value.factor = roughness;
    return {surface, {}, {}};
}

SurfaceDescription glass(double inside, double outside = 1.0) {
    DielectricSurface surface;
    surface.ior_inside = inside;
    surface.ior_outside = outside;
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

void expect_mean(const Rendering& rendering, double expected, double largest_error,
                 const std::string& name) {
    for (std::uint32_t c = 0; c < 3; ++c)
        test::expect_estimate(test::beauty_of(rendering, c), expected,
                              {comparisons, largest_error, 1e-5},
                              name + " channel " + std::to_string(c));
}

std::string on(TestBackend backend, const std::string& what) {
    return std::string(test::backend_name(backend)) + " " + what;
}

/// The picture of a sphere that fills most of it, in surroundings of radiance 1.
Rendering sphere_in_a_furnace(TestBackend backend, const SurfaceDescription& surface,
                              std::uint32_t samples, std::uint32_t seed) {
    SceneBuilder builder;
    builder.scene.environment = Environment{glm::vec3(1.0F)};
    builder.add(test::icosphere(3, false), add_surface(builder, surface));
    return test::path_image(backend, builder.scene, test::look_at({0, 0, 3}, {0, 0, 0}, 0.6),
                            test::path_settings(16, 16, samples, seed));
}

TEST(PathSurfaces, WhiteMetalIsInvisibleInAFurnace) {
    for (const TestBackend backend : test::light_backends())
        for (const float roughness : {0.0F, 0.1F, 0.3F, 1.0F}) {
            const Rendering image = sphere_in_a_furnace(backend, metal(roughness), 64, 1);
            // The albedo tables lie up to 0.5 % of what they tell above the truth.
            for (std::uint32_t c = 0; c < 3; ++c) {
                const auto found = test::beauty_of(image, c);
                EXPECT_LE(found.mean, 1.0 + 6.0 * found.error + 1e-5)
                    << on(backend, "metal ") << roughness;
                EXPECT_GE(found.mean, 0.995 - 6.0 * found.error)
                    << on(backend, "metal ") << roughness;
            }
        }
}

TEST(PathSurfaces, ClearGlassIsInvisibleInAFurnace) {
    for (const TestBackend backend : test::light_backends())
        for (const double index : {1.0, 1.33, 1.5, 2.42})
            expect_mean(sphere_in_a_furnace(backend, glass(index), 256, 2), 1.0, 0.005,
                        on(backend, "glass " + std::to_string(index)));
}

/// A slab of glass before a wall of radiance 1, all else black: the camera looks through it.
Scene slab_before_a_wall(const SurfaceDescription& surface) {
    SceneBuilder builder;
    builder.add(test::quad_mesh({-40, -40, -3}, {80, 0, 0}, {0, 80, 0}),
                builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    // A box that is much wider than it is seen, whose edges are black from everywhere.
    Mesh box = test::room_mesh();
    for (auto& triangle : box.triangles) std::swap(triangle[1], triangle[2]);
    builder.add(box, add_surface(builder, surface),
                glm::scale(glm::dmat4(1.0), glm::dvec3(30.0, 30.0, 0.1)));
    return std::move(builder.scene);
}

double reflectance(double eta) {
    const double root = (eta - 1.0) / (eta + 1.0);
    return root * root;
}

TEST(PathSurfaces, ASlabOfGlassTransmitsAllInternalReflections) {
    for (const TestBackend backend : test::light_backends())
        for (const double eta : {1.33, 1.5, 2.42}) {
            const double f = reflectance(eta);
            expect_mean(test::path_image(backend, slab_before_a_wall(glass(eta)),
                                         test::look_at({0, 0, 5}, {0, 0, 0}, 0.01),
                                         test::path_settings(16, 16, 512, 3)),
                        (1.0 - f) / (1.0 + f), 0.01, on(backend, "slab " + std::to_string(eta)));
        }
}

TEST(PathSurfaces, AnAbsorbingSlabHasItsClosedForm) {
    MetallicSurface surface;
    surface.metallic.factor = 0.0F;
    surface.roughness.value.factor = 0.0F;
    surface.transmission.factor = 1.0F;
    surface.solid = true;
    surface.absorption.colour = glm::vec3(0.5F);
    surface.absorption.distance = 0.2;  // as thick as the slab
    const double f = reflectance(1.5);
    const double a = 0.5;
    for (const TestBackend backend : test::light_backends())
        expect_mean(test::path_image(backend, slab_before_a_wall({surface, {}, {}}),
                                     test::look_at({0, 0, 5}, {0, 0, 0}, 0.01),
                                     test::path_settings(16, 16, 512, 4)),
                    a * (1.0 - f) * (1.0 - f) / (1.0 - a * a * f * f), 0.01,
                    on(backend, "absorbing slab"));
}

TEST(PathSurfaces, ALampInGlassShinesByTheSquareOfTheIndex) {
    // Seen straight on, the radiance is L (1 - F) / n^2, since all other orders miss the lamp: its
    // front absorbs what comes back.
    constexpr double eta = 1.5;
    SceneBuilder builder;
    builder.add(test::quad_mesh({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}),
                builder.material(glm::vec3(0.0F), glm::vec3(2.0F)));
    Mesh box = test::room_mesh();
    for (auto& triangle : box.triangles) std::swap(triangle[1], triangle[2]);
    builder.add(box, add_surface(builder, glass(eta)),
                glm::scale(glm::dmat4(1.0), glm::dvec3(30.0, 30.0, 0.5)));
    const double f = reflectance(eta);
    // The lamp's face shows its radiance again by reflection at the boundary: no, it is black.
    for (const TestBackend backend : test::light_backends())
        expect_mean(
            test::path_image(backend, builder.scene, test::look_at({0, 0, 5}, {0, 0, 0}, 0.01),
                             test::path_settings(16, 16, 256, 5)),
            2.0 * (1.0 - f) / (eta * eta), 0.01, on(backend, "lamp in glass"));
}

TEST(PathSurfaces, GlassInGlassOfTheSameIndexIsInvisible) {
    // The inner sphere counts; its boundary has the same index on both sides.
    for (const bool inner : {false, true}) {
        SceneBuilder builder;
        builder.add(test::quad_mesh({-40, -40, -3}, {80, 0, 0}, {0, 80, 0}),
                    builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
        Mesh box = test::room_mesh();
        for (auto& triangle : box.triangles) std::swap(triangle[1], triangle[2]);
        builder.add(box, add_surface(builder, glass(1.5)),
                    glm::scale(glm::dmat4(1.0), glm::dvec3(30.0, 30.0, 0.5)));
        if (inner)
            builder.add(test::icosphere(2, false), add_surface(builder, glass(1.5)),
                        test::placement(0.3, {0, 0, 0.1}));
        const double f = reflectance(1.5);
        for (const TestBackend backend : test::light_backends())
            expect_mean(
                test::path_image(backend, builder.scene, test::look_at({0, 0, 5}, {0, 0, 0}, 0.01),
                                 test::path_settings(16, 16, 512, 6)),
                (1.0 - f) / (1.0 + f), 0.01, on(backend, inner ? "glass in glass" : "glass"));
    }
}

TEST(PathSurfaces, SheetsLetTheirShareOfLightPass) {
    // Seen before a bright wall, and as the shadow of a lamp on a floor.
    constexpr float alpha = 0.3F;
    for (const int sheets : {1, 3, 6}) {
        const double passes = std::pow(1.0 - static_cast<double>(alpha), sheets);
        SceneBuilder seen;
        seen.add(test::quad_mesh({-40, -40, -3}, {80, 0, 0}, {0, 80, 0}),
                 seen.material(glm::vec3(0.0F), glm::vec3(1.0F)));
        SceneBuilder shadow;
        shadow.add(test::quad_mesh({-3, -3, -2}, {6, 0, 0}, {0, 6, 0}),
                   shadow.material(glm::vec3(0.5F)));
        shadow.light(LightType::directional, {}, glm::vec3(1.0F));
        for (int i = 0; i < sheets; ++i) {
            const float z = 0.1F * static_cast<float>(i);
            for (SceneBuilder* const builder : {&seen, &shadow})
                builder->add(test::quad_mesh({-40, -40, z}, {80, 0, 0}, {0, 80, 0}),
                             add_surface(*builder, sheet(alpha)));
        }
        for (const TestBackend backend : test::light_backends()) {
            const std::string name = on(backend, std::to_string(sheets) + " sheets");
            expect_mean(
                test::path_image(backend, seen.scene, test::look_at({0, 0, 5}, {0, 0, 0}, 0.01),
                                 test::path_settings(16, 16, 256, 7)),
                passes, 0.02, name);
            // From below the sheets, the floor is seen as it is.
            expect_mean(
                test::path_image(backend, shadow.scene, test::look_at({0, 0, -1}, {0, 0, -2}, 0.5),
                                 test::path_settings(16, 16, 4, 8)),
                0.5 / std::numbers::pi * passes, 0.001, name + " shadow");
        }
    }
}

TEST(PathSurfaces, SameBitsOnAllBackendsAndInParts) {
    SceneBuilder builder;
    builder.scene.environment = Environment{glm::vec3(0.3F)};
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.6F)));
    builder.add(test::quad_mesh({-0.3F, 0.9F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    builder.add(test::icosphere(2, false), add_surface(builder, metal(0.3F, {0.9F, 0.6F, 0.3F})),
                test::placement(0.3, {-0.4, -0.5, 0}));
    builder.add(test::icosphere(2, false), add_surface(builder, glass(1.5)),
                test::placement(0.3, {0.4, -0.5, 0}));
    builder.add(test::quad_mesh({-0.5F, -0.5F, 0.5F}, {1, 0, 0}, {0, 0.5F, 0}),
                add_surface(builder, sheet(0.5F)));
    const FlatScene flat = flatten(builder.scene);
    const Camera camera = test::look_at({0, 0, 0.95}, {0, -0.2, -1}, 1.2);
    const auto sums = [&](TestBackend backend, std::uint32_t first, std::uint32_t end) {
        PathSettings settings = test::path_settings(24, 24, end, 9);
        settings.samples = {first, end};
        return test::path_sums(test::shared_executor(backend), flat, camera, settings);
    };
    const FilmSums whole = sums(TestBackend::own_bvh, 0, 8);
    FilmSums parts = sums(TestBackend::own_bvh, 0, 3);
    add_sums(parts, sums(TestBackend::own_bvh, 3, 8));
    test::expect_same_sums(whole, parts);
    for (const TestBackend backend : test::light_backends())
        test::expect_same_sums(whole, sums(backend, 0, 8));
}

}  // namespace
}  // namespace weft::path_surfaces_test
