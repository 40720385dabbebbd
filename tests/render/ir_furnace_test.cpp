// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "tests/testing/closed_forms.h"
#include "tests/testing/render_fixture.h"

// Instant Radiosity in surroundings where every order of light is known everywhere: closed rooms
// whose surfaces all emit e and reflect rho, and two concentric spheres that differ in both.
//
// Direct light is the first order, rho e in a furnace; the VPLs of b bounces are the next b orders,
// e (rho^2 + ... + rho^(b + 1)). In a furnace that is exact for any closed shape, facets and
// objects within included, since irradiance is pi e wherever everything in sight has radiance e.
// Beside an edge the geometry term is large and rare, but the nearest pixels are an eighth of a
// wall away from it, so that variances are finite.
//
// The mean over all pixels is one observation; those of 24 seeds are compared with the closed form
// by Student's t with 23 degrees of freedom. A correct renderer would fail any of 150
// comparisons (this file makes fewer) with a probability of 1e-3, which is a limit of 5.8 standard
// errors; seeds are fixed. Standard errors are bounded as well, or these comparisons would accept
// anything: sphere and room find light that is off by 1 %, the others by 1 to 5 %.
namespace weft::ir_furnace_test {
namespace {

using test::SceneBuilder;
using test::TestBackend;

constexpr std::uint32_t seeds = 24;
constexpr std::size_t comparisons = 150;
constexpr double failure = 1e-3;   // of any of them
constexpr double rounding = 5e-6;  // floats: VPLs lie off their surfaces, sums have some 600 terms

/// Standard errors that the mean of all seeds may be off.
double student_limit() {
    static const double limit = selftest::student_limit(seeds, comparisons, failure);
    return limit;
}

/// What one seed gives: means of both layers over the pixels of a surface.
struct Layers {
    glm::dvec3 direct{0.0};
    glm::dvec3 indirect{0.0};
};

/// A surface that emits and reflects evenly.
struct SphereSurface {
    glm::vec3 albedo{0.0F};
    glm::vec3 emission{0.0F};
};

/// Adds the pixels that show `surface`, told from others by its albedo; returns their number.
double add_pixels(const test::Rendering& rendering, const SphereSurface& surface, Layers& sum) {
    double pixels = 0.0;
    for (std::uint32_t y = 0; y < rendering.image.height; ++y)
        for (std::uint32_t x = 0; x < rendering.image.width; ++x) {
            if (rendering.at("albedo", x, y, 0) != surface.albedo[0]) continue;
            pixels += 1.0;
            for (std::uint32_t c = 0; c < 3; ++c) {
                const auto channel = static_cast<glm::length_t>(c);
                sum.direct[channel] += static_cast<double>(rendering.at("direct", x, y, c));
                sum.indirect[channel] += static_cast<double>(rendering.at("indirect", x, y, c));
                EXPECT_EQ(rendering.at("emission", x, y, c), surface.emission[channel]);
            }
        }
    return pixels;
}

RenderSettings furnace_settings(std::uint32_t bounces = 4) {
    RenderSettings settings = test::unbounded(test::small_settings(Algorithm::ir, 8, 8));
    settings.sampling.bounces = bounces;
    settings.sampling.vpl_tail = false;
    settings.sampling.vpls_per_set = 128;
    settings.sampling.samples_per_light = 32;
    return settings;
}

/// Surfaces and the form factors between them: row i holds what shares of its light i receives
/// from each.
struct Enclosure {
    std::vector<SphereSurface> surfaces;
    std::vector<std::vector<double>> form_factors;
};

/// Radiance that surface `i` has in both layers after `bounces`.
Layers expected_layers(const Enclosure& enclosure, std::size_t i, std::uint32_t bounces) {
    const std::size_t n = enclosure.surfaces.size();
    std::vector<glm::dvec3> order(n);
    for (std::size_t k = 0; k < n; ++k) order[k] = enclosure.surfaces[k].emission;
    Layers layers;
    for (std::uint32_t bounce = 0; bounce <= bounces; ++bounce) {
        std::vector<glm::dvec3> next(n, glm::dvec3(0.0));
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t from = 0; from < n; ++from)
                next[k] += glm::dvec3(enclosure.surfaces[k].albedo) * order[from] *
                           enclosure.form_factors[k][from];
        order = next;
        (bounce == 0 ? layers.direct : layers.indirect) += order[i];
    }
    return layers;
}

/// What estimates may be off.
struct Tolerance {
    double direct = 0.0;  ///< largest relative standard error
    double indirect = 0.0;
    double bias = rounding;  ///< relative, of the model
};

void expect_value(const std::vector<Layers>& found, glm::dvec3 Layers::*layer,
                  const glm::dvec3& expected, double largest_error, double bias) {
    for (glm::length_t c = 0; c < 3; ++c) {
        std::vector<double> values;
        for (const Layers& one : found) values.push_back((one.*layer)[c]);
        const auto [mean, error] = test::estimate(values);
        EXPECT_LE(error, largest_error * expected[c]) << "channel " << c;
        EXPECT_NEAR(mean, expected[c], student_limit() * error + bias * expected[c])
            << "channel " << c << ", standard error " << error;
    }
}

/// That the enclosure's surfaces have its light, each in the mean over the pixels of all `cameras`
/// that show it.
void expect_light(TestBackend backend, const SceneBuilder& builder,
                  const std::vector<Camera>& cameras, RenderSettings settings,
                  const Enclosure& enclosure, const Tolerance& tolerance) {
    SCOPED_TRACE(test::backend_name(backend));
    validate_scene(builder.scene);
    const FlatScene flat = flatten(builder.scene);
    const std::uint32_t bounces = settings.indirect ? settings.sampling.bounces : 0;
    const std::size_t surfaces = enclosure.surfaces.size();
    std::vector<std::vector<Layers>> found(surfaces, std::vector<Layers>(seeds));
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        settings.seed = seed;
        std::vector<double> pixels(surfaces, 0.0);
        for (const Camera& camera : cameras) {
            const test::Rendering rendering =
                test::render_flat(test::shared_executor(backend), flat, camera, settings);
            test::expect_clean(rendering);
            ASSERT_EQ(rendering.plan.bounces, bounces);
            for (std::size_t i = 0; i < surfaces; ++i)
                pixels[i] += add_pixels(rendering, enclosure.surfaces[i], found[i][seed]);
        }
        for (std::size_t i = 0; i < surfaces; ++i) {
            ASSERT_GE(pixels[i], 20.0);
            found[i][seed].direct /= pixels[i];
            found[i][seed].indirect /= pixels[i];
        }
    }
    for (std::size_t i = 0; i < surfaces; ++i) {
        SCOPED_TRACE("surface " + std::to_string(i));
        const Layers expected = expected_layers(enclosure, i, bounces);
        expect_value(found[i], &Layers::direct, expected.direct, tolerance.direct, tolerance.bias);
        expect_value(found[i], &Layers::indirect, expected.indirect, tolerance.indirect,
                     tolerance.bias);
    }
}

Enclosure furnace(const glm::vec3& albedo, const glm::vec3& emission) {
    return {{{albedo, emission}}, {{1.0}}};
}

/// From the centre along each axis: in [-1, 1]^3 every image is one wall, in equal pieces.
std::vector<Camera> to_six_sides() {
    std::vector<Camera> cameras;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 at(0.0);
            at[axis] = side;
            cameras.push_back(test::look_at({0, 0, 0}, at, std::numbers::pi / 2.0));
        }
    return cameras;
}

TEST(IrFurnace, TheFirstOrdersInClosedForm) {
    // rho e, and e rho^2 (1 - rho^b) / (1 - rho).
    const Enclosure grey = furnace({0.1F, 0.5F, 0.9F}, {1.0F, 2.0F, 0.5F});
    const Layers found = expected_layers(grey, 0, 4);
    EXPECT_NEAR(found.direct.y, 1.0, 1e-12);
    EXPECT_NEAR(found.indirect.y, 2.0 * (0.25 + 0.125 + 0.0625 + 0.03125), 1e-12);
    EXPECT_NEAR(selftest::student_tail(2.068657610, 23.0), 0.05, 1e-9);  // tables of Student's t
}

TEST(IrFurnace, SphereThatEmitsEverywhere) {
    // Almost without variance: the geometry term is that of a sphere but for its facets.
    const Enclosure grey = furnace({0.1F, 0.5F, 0.9F}, {1.0F, 2.0F, 0.5F});
    SceneBuilder builder;
    builder.add(test::icosphere(3, true),
                builder.material(grey.surfaces[0].albedo, grey.surfaces[0].emission));
    for (const TestBackend backend : test::light_backends())
        expect_light(backend, builder, {test::look_at({0.1, -0.2, 0.3}, {-0.5, 0.3, -0.8}, 1.2)},
                     furnace_settings(), grey, {6e-4, 6e-4});
}

TEST(IrFurnace, RoomThatEmitsEverywhere) {
    const Enclosure grey = furnace({0.5F, 0.9F, 0.1F}, {1.0F, 2.0F, 0.5F});
    SceneBuilder builder;
    builder.add(test::room_mesh(),
                builder.material(grey.surfaces[0].albedo, grey.surfaces[0].emission));
    for (const TestBackend backend : test::light_backends())
        for (const std::uint32_t bounces : {1U, 8U}) {
            SCOPED_TRACE("bounces " + std::to_string(bounces));
            expect_light(backend, builder, to_six_sides(), furnace_settings(bounces), grey,
                         {1e-3, 1.5e-3});
        }
}

TEST(IrFurnace, HoldsWithObjectsWithin) {
    // Lights of very different sizes, which hide others, and both sides of one; sampled each, or
    // chosen by power.
    const Enclosure grey = furnace({0.5F, 0.8F, 0.3F}, {1.0F, 2.0F, 0.5F});
    SceneBuilder builder;
    const std::uint32_t material =
        builder.material(grey.surfaces[0].albedo, grey.surfaces[0].emission);
    const std::uint32_t both = builder.material(grey.surfaces[0].albedo, grey.surfaces[0].emission);
    builder.scene.materials[both].emission.both_sides = true;
    builder.add(test::room_mesh(), material);
    builder.add(test::icosphere(1, false), material, test::placement(0.3, {-0.4, -0.2, -0.3}));
    builder.add(test::icosphere(1, false), material, test::placement(0.05, {0.2, 0.4, -0.1}));
    builder.add(test::quad_mesh({0.3F, -0.6F, -0.5F}, {0.4F, 0.1F, 0.0F}, {0.0F, 0.6F, 0.2F}),
                both);
    for (const TestBackend backend : test::light_backends())
        for (const bool by_power : {false, true}) {
            SCOPED_TRACE(by_power ? "lights by power" : "every light");
            RenderSettings settings = furnace_settings();
            settings.sampling.samples_per_light = by_power ? 64 : 24;
            settings.sampling.max_samples_per_set = 96;
            settings.indirect = !by_power;
            expect_light(backend, builder, to_six_sides(), settings, grey, {2e-3, 2e-3});
        }
}

TEST(IrFurnace, ConcentricSpheres) {
    // The finite form of parallel plates: all that the inner sphere (0) sends goes to the outer one
    // (1), so F01 = 1, F10 = A0 / A1 by reciprocity, and F11 = 1 - F10. By symmetry each sphere has
    // the same radiance all over. Facets, whose ratio of areas is that of the spheres, take some of
    // that away: they reach (0.3 / sqrt 3)^2 / 2 = 1.5 % inside, with less and with more of F10 at
    // their middles and corners, which leaves some 1e-3 in the mean over the pixels.
    constexpr double facets = 2e-3;
    constexpr double radius = 0.5;
    constexpr double share = radius * radius;
    const Enclosure spheres = {
        {{{0.5F, 0.8F, 0.3F}, {1.0F, 0.2F, 0.1F}}, {{0.7F, 0.4F, 0.9F}, {0.3F, 1.0F, 2.0F}}},
        {{0.0, 1.0}, {share, 1.0 - share}}};
    SceneBuilder builder;
    for (const SphereSurface& surface : spheres.surfaces) {
        const bool outer = &surface == &spheres.surfaces[1];
        builder.add(test::icosphere(2, outer), builder.material(surface.albedo, surface.emission),
                    test::placement(outer ? 1.0 : radius, glm::dvec3(0.0)));
    }
    std::vector<Camera> cameras;
    for (const Camera& side : to_six_sides()) {
        const glm::dvec3 backward(side.to_world[2]);
        cameras.push_back(
            test::look_at(0.85 * backward + glm::dvec3(0.05, 0.08, 0.03), {0, 0, 0}, 1.7));
    }
    RenderSettings settings = furnace_settings();
    settings.sampling.vpls_per_set = 160;
    for (const TestBackend backend : test::light_backends())
        expect_light(backend, builder, cameras, settings, spheres, {2e-3, 8e-3, facets});
}

}  // namespace
}  // namespace weft::ir_furnace_test
