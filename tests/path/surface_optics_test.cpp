// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "tests/testing/environment_images.h"
#include "tests/testing/floor_scenes.h"
#include "tests/testing/optics_scenes.h"
#include "tests/testing/path_fixture.h"

// Geometrical optics in whole images: slabs, prisms and lenses send light where Snell's law does,
// in the share that Fresnel's equations leave, solids within each other are one, and mirrors show
// the unfolded scene.
//
// Means are compared with closed forms by their standard errors, which the limit of 200 comparisons
// (sidak_limit: all together fail with a probability of 1e-4) has in it, more than this file makes.
// All seeds are fixed.
namespace weft::surface_optics_test {
namespace {

using test::add_surface;
using test::glass;
using test::Rendering;
using test::SceneBuilder;
using test::SeenByRay;
using test::TestBackend;

constexpr std::size_t comparisons = 200;

std::string on(TestBackend backend, const std::string& what) {
    return std::string(test::backend_name(backend)) + " " + what;
}

Rendering ray_image(TestBackend backend, const Scene& scene, const Camera& camera,
                    std::uint32_t samples, std::uint32_t seed) {
    return test::path_image(backend, scene, camera, test::path_settings(16, 16, samples, seed));
}

/// `bias` is what the model is off by, relative.
void expect_radiance(const Rendering& image, double expected, double error, double bias,
                     const std::string& what, std::uint32_t channel = 0) {
    test::expect_estimate(test::beauty_of(image, channel), expected, {comparisons, error, bias},
                          what);
}

TEST(SurfaceOptics, SlabsTransmitAllInternalReflections) {
    // (1 - F) / (1 + F), at three angles.
    const double cosines[] = {1.0, std::sqrt(0.75), 0.5};
    const double known[] = {0.923077, 0.920266, 0.836232};
    for (const TestBackend backend : test::light_backends()) {
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(test::stack_transmittance({{1.5}}, cosines[i]), known[i], 1e-6);
            expect_radiance(ray_image(backend, test::slab_before_a_wall(glass(1.5)),
                                      test::oblique_camera(cosines[i]), 384, 3),
                            known[i], 0.002, 2e-5,
                            on(backend, "slab, cosine " + std::to_string(cosines[i])));
        }
        for (const double index : {1.0 + 0x1p-9, 1.33, 2.42})
            expect_radiance(ray_image(backend, test::slab_before_a_wall(glass(index)),
                                      test::oblique_camera(0.8), 96, 4),
                            test::stack_transmittance({{index}}, 0.8), 0.005, 2e-5,
                            on(backend, "slab, index " + std::to_string(index)));
    }
}

TEST(SurfaceOptics, AbsorbingSlabsHaveTheirClosedForm) {
    // A (1 - F)^2 / (1 - A^2 F^2), where A is left of a way as long as the slab is thick.
    const glm::vec3 colour(0.5F, 0.9F, 0.1F);
    const Scene scene = test::slab_before_a_wall(test::absorbing_glass(1.5F, colour, 0.2));
    for (const TestBackend backend : test::light_backends()) {
        const Rendering image = ray_image(backend, scene, test::oblique_camera(1.0), 128, 5);
        for (std::uint32_t c = 0; c < 3; ++c) {
            const double a = test::at(colour, c);
            expect_radiance(image, a * 0.96 * 0.96 / (1.0 - a * a * 0.04 * 0.04), 0.005, 2e-5,
                            on(backend, "absorbing slab"), c);
        }
    }
}

TEST(SurfaceOptics, PrismsBendLightBySnellsLaw) {
    for (const TestBackend backend : test::light_backends()) {
        const SeenByRay met = test::target_behind_a_prism();
        expect_radiance(ray_image(backend, met.scene, met.camera, 64, 6), met.radiance, 0.01, 1e-4,
                        on(backend, "prism"));
        // The target is so small that it tells 0.3 degrees.
        for (const double aside : {-1.1, 1.1}) {
            const SeenByRay missed = test::target_behind_a_prism(aside);
            EXPECT_EQ(
                test::beauty_of(ray_image(backend, missed.scene, missed.camera, 4, 6), 0).mean, 0.0)
                << on(backend, "beside it");
        }
    }
}

TEST(SurfaceOptics, LightBeyondTheCriticalAngleIsReflectedWholly) {
    const SeenByRay seen = test::wall_by_total_reflection();
    for (const TestBackend backend : test::light_backends())
        expect_radiance(ray_image(backend, seen.scene, seen.camera, 64, 7), seen.radiance, 0.01,
                        1e-4, on(backend, "right-angled prism"));
}

TEST(SurfaceOptics, BallsOfGlassHaveTheirFocus) {
    for (const TestBackend backend : test::light_backends())
        for (const double index : {1.33, 1.5, 1.9}) {
            const SeenByRay met = test::target_at_a_focus(index);
            const std::string name = on(backend, "ball of index " + std::to_string(index));
            // Light that is reflected twice inside may meet the target as well: F^2.
            const double f = test::fresnel_reflectance(1.0, index, 1.0);
            expect_radiance(ray_image(backend, met.scene, met.camera, 64, 8), met.radiance, 0.01,
                            1e-4 + f * f, name);
            const SeenByRay missed = test::target_at_a_focus(index, 1.2);
            EXPECT_LT(
                test::beauty_of(ray_image(backend, missed.scene, missed.camera, 16, 8), 0).mean,
                2.0 * f * f + 0.002)
                << name;
        }
}

TEST(SurfaceOptics, ALampInGlassShinesByTheSquareOfTheIndex) {
    for (const TestBackend backend : test::light_backends())
        for (const double index : {1.33, 1.5}) {
            const SeenByRay seen = test::lamp_in_glass(index);
            expect_radiance(ray_image(backend, seen.scene, seen.camera, 128, 9), seen.radiance,
                            0.01, 2e-5, on(backend, "lamp in glass"));
        }
}

TEST(SurfaceOptics, GlassInGlassOfTheSameIndexIsInvisible) {
    SceneBuilder builder = test::bright_wall();
    test::add_slab(builder, glass(1.5), -0.5, 0.5);
    builder.add(test::icosphere(2, false), add_surface(builder, glass(1.5)),
                test::placement(0.3, {0, 0, 0.1}));
    for (const TestBackend backend : test::light_backends())
        expect_radiance(ray_image(backend, builder.scene, test::oblique_camera(1.0), 128, 10),
                        test::stack_transmittance({{1.5}}), 0.005, 2e-5,
                        on(backend, "glass in glass"));
}

TEST(SurfaceOptics, WaterInGlassIsTheSameHoweverFarItOverlaps) {
    for (const TestBackend backend : test::light_backends()) {
        for (const double overlap : {-0.05, 0.02, 0.25}) {
            const test::WaterInGlass water = test::water_in_glass(overlap);
            const Rendering image =
                ray_image(backend, water.scene, test::oblique_camera(1.0), 96, 11);
            for (std::uint32_t c = 0; c < 3; ++c)
                expect_radiance(image, water.radiance[static_cast<glm::length_t>(c)], 0.01, 2e-5,
                                on(backend, "overlap " + std::to_string(overlap)), c);
        }
    }
}

/// A hollow ball of coloured glass, and in it a ball of water with that radius, in a sky.
Scene water_in_a_ball(double radius) {
    SceneBuilder builder;
    builder.scene.environment = Environment{
        glm::vec3(1.0F), std::make_shared<const EnvironmentImage>(
                             test::image_of(8, 5, false, [](const glm::dvec3& d) {
                                 return glm::vec3(float(1.2 + d.y), float(1.5 - d.x), 1.0F);
                             }))};
    Mesh hollow = test::icosphere(3, false);
    const Mesh inner = test::icosphere(3, true);
    const auto first = static_cast<std::uint32_t>(hollow.positions.size());
    for (const glm::vec3& p : inner.positions) hollow.positions.push_back(0.8F * p);
    for (const auto& [a, b, c] : inner.triangles)
        hollow.triangles.push_back({first + a, first + b, first + c});
    builder.add(hollow, add_surface(builder, test::absorbing_glass(1.5F, {0.9F, 0.4F, 0.2F}, 0.2)));
    builder.add(test::icosphere(3, false), add_surface(builder, glass(1.33)),
                test::placement(radius, {0, 0, 0}));
    return std::move(builder.scene);
}

TEST(SurfaceOptics, PicturesOfWaterInABallOfGlassAreEqual) {
    // Two overlaps, pixel by pixel: of 192 comparisons none may be off by more than 4.9 standard
    // errors, as one of a million does.
    for (const TestBackend backend : test::light_backends()) {
        Rendering images[2];
        for (const int i : {0, 1})
            images[i] = test::path_image(backend, water_in_a_ball(i == 0 ? 0.84 : 0.96),
                                         test::look_at({0, 0.5, 4}, {0, 0, 0}, 0.55),
                                         test::path_settings(8, 8, 256, 12));
        for (std::uint32_t c = 0; c < 3; ++c)
            for (std::uint32_t i = 0; i < 64; ++i) {
                const std::uint32_t x = i % 8;
                const std::uint32_t y = i / 8;
                const double off = double(images[0].at("", x, y, c) - images[1].at("", x, y, c));
                const double variance = double(images[0].at("variance", x, y, c)) +
                                        double(images[1].at("variance", x, y, c));
                EXPECT_LE(std::abs(off), 4.9 * std::sqrt(variance) + 1e-4)
                    << on(backend, "pixel ") << x << ' ' << y;
            }
    }
}

TEST(SurfaceOptics, SolidsOfTheIndexAroundThemChangeNoLight) {
    // They block shadow rays, as all glass does, so that rays have to find the lamp behind them: a
    // slab by itself, and one whose surface lies within another, where it is absent.
    const double irradiance =
        test::polygon_irradiance(test::corners_of(test::area_light_mesh()), {0, 0, 0}, {0, 0, 1});
    for (const int solids : {1, 2})
        for (const bool sheets : {false, true}) {
            SceneBuilder builder = test::floor_scene();
            builder.add(test::area_light_mesh(),
                        builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
            test::add_slab(builder, glass(1.0), 0.4, 0.6);
            if (solids == 2) test::add_slab(builder, glass(1.0), 0.5, 0.9);
            // Somewhere, so that shadow rays look for what lets them pass.
            if (sheets)
                builder.add(test::quad_mesh({9, 9, 0}, {1, 0, 0}, {0, 1, 0}),
                            add_surface(builder, test::sheet(0.5F)));
            for (const TestBackend backend : test::light_backends())
                test::expect_estimate(
                    test::layer_of(
                        test::path_image(backend, builder.scene,
                                         test::look_at(test::eye_offset, {0, 0, 0}, 0.001),
                                         test::path_settings(16, 16, 96, 13)),
                        "direct", 0),
                    test::at(test::receiver_albedo, 0) / std::numbers::pi * irradiance,
                    {comparisons, 0.02, 1e-4}, on(backend, std::to_string(solids) + " solids"));
        }
}

TEST(SurfaceOptics, ABoxOfMirrorsIsTheUnfoldedScene) {
    for (const TestBackend backend : test::light_backends()) {
        PathSettings settings = test::path_settings(40, 40, 1, 14);
        settings.through_centres = true;
        settings.most_bounces = test::most_mirrors;
        const Rendering mirrored = test::path_image(backend, test::box_of_mirrors(),
                                                    test::camera_among_mirrors(), settings);
        const Rendering unfolded = test::path_image(backend, test::unfolded_box_of_mirrors(),
                                                    test::camera_among_mirrors(), settings);
        // Roulette ends one of 1000 paths at each mirror but the first two, and makes the others
        // 1/1000 brighter; at edges rounding decides.
        int unlike = 0;
        double sums[2] = {0.0, 0.0};
        for (std::uint32_t y = 0; y < 40; ++y)
            for (std::uint32_t x = 0; x < 40; ++x) {
                const double a = double(mirrored.at("", x, y));
                const double b = double(unfolded.at("", x, y));
                sums[0] += a;
                sums[1] += b;
                unlike += std::abs(a - b) > 0.005 * b ? 1 : 0;
            }
        EXPECT_LE(unlike, 16) << test::backend_name(backend);
        EXPECT_NEAR(sums[0], sums[1], 0.01 * sums[1]) << test::backend_name(backend);
        EXPECT_GT(sums[1], 40.0);  // or there would be nothing to compare
    }
}

}  // namespace
}  // namespace weft::surface_optics_test
