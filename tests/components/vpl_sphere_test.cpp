// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/testing/render_fixture.h"

// The integrating sphere: two points of a sphere of radius R see each other with the geometry term
// 1 / (4 R^2) wherever they are, so every set of VPLs gives the same irradiance everywhere, without
// variance. A light of intensity I at the centre gives I / R^2 directly and, with fractional
// absorption, exactly (I / R^2) (rho + ... + rho^n) by n bounces, or with the light of all that
// follow (I / R^2) rho / (1 - rho): wrong normalisation has nowhere to hide.
//
// Tolerances. The icosphere of level 6 has edges below 0.019 R, so triangles reach at most
// (0.019 / sqrt 3)^2 / 2 = 6e-5 R inside the sphere: the direct irradiance cos / d^2 is off by at
// most 2 * 6e-5 per pixel, and float adds some 1e-6. Between a pixel and a VPL at distance d, the
// normals' tilt of up to 0.011 makes an error of up to 2 * 0.011 R / d of either sign, so a pixel
// beside a VPL may miss or double its share; over all pixels and VPLs what stays is of second
// order. At level 5 edges are twice as long, and all of this four times as large.
namespace weft::vpl_sphere_test {
namespace {

using test::Rendering;
using test::TestBackend;

constexpr double direct_tolerance = 1.5e-4;
constexpr double mean_tolerance = 5e-4;
// Of a set's VPLs the last four bounces have one each, which brings a percent or two of the light.
constexpr double pixel_tolerance = 0.2;

struct Sphere {
    double radius = 1.0;
    glm::dvec3 centre{0.0};
    glm::vec3 intensity{1.0F};
    glm::vec3 albedo{0.5F};
    std::uint32_t level = 6;
};

const Mesh& sphere_mesh(std::uint32_t level) {
    static std::map<std::uint32_t, Mesh> meshes;
    const auto [at, is_new] = meshes.try_emplace(level);
    if (is_new) at->second = test::icosphere(level, true);
    return at->second;
}

Rendering render_sphere(TestBackend backend, const Sphere& sphere, const RenderSettings& settings,
                        std::uint32_t frames = 1) {
    test::SceneBuilder builder;
    builder.add(sphere_mesh(sphere.level), builder.material(sphere.albedo),
                test::placement(sphere.radius, sphere.centre));
    builder.light(LightType::point, sphere.centre, sphere.intensity);
    const Camera camera =
        test::look_at(sphere.centre + sphere.radius * glm::dvec3(0.1, -0.2, 0.3),
                      sphere.centre + sphere.radius * glm::dvec3(-0.5, 0.3, -0.8), 1.2);
    return test::render(backend, builder.scene, camera, test::unbounded(settings), frames);
}

double orders_of_light(double rho, std::uint32_t bounces) {
    double sum = 0.0;
    for (std::uint32_t k = 1; k <= bounces; ++k) sum += std::pow(rho, k);
    return sum;
}

/// Indirect light over direct light.
double indirect_light(double rho, const SamplingSettings& sampling) {
    return sampling.vpl_tail ? rho / (1.0 - rho) : orders_of_light(rho, sampling.bounces);
}

/// Largest relative deviation of any pixel's irradiance, and that of their mean.
struct Deviation {
    double pixel = 0.0;
    double mean = 0.0;
};

Deviation deviation(const Rendering& rendering, const char* layer, std::uint32_t channel,
                    double expected) {
    Deviation result;
    double sum = 0.0;
    for (std::uint32_t y = 0; y < rendering.image.height; ++y)
        for (std::uint32_t x = 0; x < rendering.image.width; ++x) {
            const double e = rendering.irradiance(layer, x, y, channel) / expected - 1.0;
            sum += e;
            result.pixel = std::isfinite(e) ? std::max(result.pixel, std::abs(e)) : e;
        }
    result.mean = sum / (static_cast<double>(rendering.image.width) * rendering.image.height);
    return result;
}

void expect_closed_form(const Rendering& rendering, const Sphere& sphere,
                        const RenderSettings& settings) {
    test::expect_clean(rendering);
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
        SCOPED_TRACE("channel " + std::to_string(channel));
        const auto c = static_cast<glm::length_t>(channel);
        const double direct =
            static_cast<double>(sphere.intensity[c]) / (sphere.radius * sphere.radius);
        const double indirect =
            direct * indirect_light(static_cast<double>(sphere.albedo[c]), settings.sampling);
        EXPECT_LE(deviation(rendering, "direct", channel, direct).pixel, direct_tolerance);
        const Deviation found = deviation(rendering, "indirect", channel, indirect);
        EXPECT_LE(std::abs(found.mean), mean_tolerance);
        EXPECT_LE(found.pixel, pixel_tolerance);
    }
}

TEST(VplSphere, IrradianceEqualsItsClosedFormOnEveryBackend) {
    Sphere sphere;
    // With more reflectance the few VPLs of the last bounce, whose tail is long, have too much
    // weight for errors beside them to stay of second order.
    sphere.albedo = {0.7F, 0.5F, 0.1F};
    sphere.intensity = {1.0F, 20.0F, 3.0F};
    for (const TestBackend backend : test::backends())
        for (const Algorithm algorithm : {Algorithm::igi, Algorithm::ir}) {
            SCOPED_TRACE(std::string(test::backend_name(backend)) +
                         (algorithm == Algorithm::igi ? " igi" : " ir"));
            const RenderSettings settings = test::small_settings(algorithm, 64, 48);
            expect_closed_form(render_sphere(backend, sphere, settings), sphere, settings);
        }
}

TEST(VplSphere, ThePublishedCaseHasRadianceOne) {
    // rho = 1/2, I = pi, R = 1: L = (rho / pi) (I / R^2) / (1 - rho) = 1. Without the tail, four
    // bounces after the direct light leave out the orders from 5 on, (1/2)^5 of the whole.
    Sphere sphere;
    sphere.intensity = glm::vec3(std::numbers::pi_v<float>);
    RenderSettings settings = test::small_settings(Algorithm::ir, 32, 32);
    for (const TestBackend backend : test::light_backends()) {
        settings.sampling.vpl_tail = true;
        const Rendering whole = render_sphere(backend, sphere, settings);
        EXPECT_NEAR(test::mean_of(whole.layer("")), 1.0, 5e-4) << test::backend_name(backend);
        settings.sampling.vpl_tail = false;
        settings.sampling.bounces = 4;
        const Rendering cut = render_sphere(backend, sphere, settings);
        EXPECT_NEAR(test::mean_of(cut.layer("")), 1.0 - 1.0 / 32.0, 5e-4)
            << test::backend_name(backend);
    }
}

TEST(VplSphere, HoldsForEveryReflectanceBounceCountAndNumberOfVpls) {
    // With 64 VPLs and these reflectances floor(N r^k) is 0 and raised to 1, just below and just
    // above a whole number, or N itself; 0.02 and 0.99 lie outside the plan's own limits.
    struct Case {
        float rho;
        std::uint32_t bounces, vpls;
    };
    for (const Case& c : {Case{0.02F, 4, 64}, Case{0.31F, 4, 64}, Case{0.5F, 4, 64},
                          Case{0.77F, 4, 64}, Case{0.99F, 4, 64}, Case{1.0F, 8, 64},
                          Case{0.64F, 1, 7}, Case{0.64F, 3, 3}, Case{0.8F, 8, 30}}) {
        SCOPED_TRACE("rho " + std::to_string(c.rho));
        Sphere sphere;
        sphere.level = 5;
        sphere.albedo = glm::vec3(c.rho);
        RenderSettings settings = test::small_settings(Algorithm::ir, 32, 24);
        settings.sampling.bounces = c.bounces;
        settings.sampling.vpl_tail = false;  // knows no ratio above 0.95, nor of one bounce
        settings.sampling.vpls_per_set = c.vpls;
        const Rendering rendering = render_sphere(TestBackend::own_bvh, sphere, settings);
        test::expect_clean(rendering);
        const Deviation found = deviation(rendering, "indirect", 0,
                                          orders_of_light(static_cast<double>(c.rho), c.bounces));
        EXPECT_LE(std::abs(found.mean), 4.0 * mean_tolerance);
    }
}

TEST(VplSphere, HoldsForEverySeedAndAfterSeveralFrames) {
    const Sphere sphere;
    for (const std::uint32_t seed : {1U, 2U, 77U, 0xFFFFFFFFU}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        RenderSettings settings = test::small_settings(Algorithm::igi, 48, 33);
        settings.seed = seed;
        expect_closed_form(render_sphere(TestBackend::own_bvh, sphere, settings, 3), sphere,
                           settings);
    }
}

TEST(VplSphere, HoldsForEverySizeAndPlace) {
    for (const TestBackend backend : test::light_backends())
        for (const double radius : {1e-3, 0.037, 1e3})
            for (const glm::dvec3& centre : {glm::dvec3(0.0), glm::dvec3(1e5, 1e3, -2e5)}) {
                SCOPED_TRACE(std::string(test::backend_name(backend)) + " radius " +
                             std::to_string(radius) + " centre " + std::to_string(centre.x));
                Sphere sphere;
                sphere.radius = radius;
                sphere.centre = centre;
                sphere.level = 5;
                const RenderSettings settings = test::small_settings(Algorithm::igi, 32, 24);
                const Rendering rendering = render_sphere(backend, sphere, settings);
                test::expect_clean(rendering);
                const double direct = 1.0 / (radius * radius);
                EXPECT_LE(deviation(rendering, "direct", 0, direct).pixel, 4 * direct_tolerance);
                const double indirect = direct * indirect_light(0.5, settings.sampling);
                EXPECT_LE(std::abs(deviation(rendering, "indirect", 0, indirect).mean),
                          4 * mean_tolerance);
            }
}

TEST(VplSphere, TheBoundCutsWhatItSaysAndNothingElse) {
    const Sphere sphere;
    RenderSettings settings = test::small_settings(Algorithm::ir, 32, 24);
    settings.sampling.local_bounds = false;
    const double expected = indirect_light(0.5, settings.sampling);
    test::SceneBuilder builder;
    builder.add(sphere_mesh(5), builder.material(sphere.albedo));
    builder.light(LightType::point, {0.0, 0.0, 0.0}, sphere.intensity);
    const Camera camera = test::look_at({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 1.2);
    for (const double spacing : {0.5, 1.0, 4.0}) {
        settings.sampling.bound_spacing = spacing;
        const Rendering rendering =
            test::render(TestBackend::own_bvh, builder.scene, camera, settings);
        // On the sphere G is 1 / (4 R^2) at any distance, so the bound pi N / (c^2 4 pi R^2) is
        // above it for every c < sqrt N: it must not bite at all.
        const double n = static_cast<double>(rendering.plan.sets) * rendering.plan.vpls_per_set;
        ASSERT_GT(n, 2.0 * spacing * spacing);
        EXPECT_LE(std::abs(deviation(rendering, "indirect", 0, expected).mean), 4 * mean_tolerance);
    }
    // Far above sqrt N it cuts every connection to the bound: the irradiance is known again.
    settings.sampling.bound_spacing = 100.0;
    const Rendering rendering = test::render(TestBackend::own_bvh, builder.scene, camera, settings);
    const double n = static_cast<double>(rendering.plan.sets) * rendering.plan.vpls_per_set;
    const double share = n / (100.0 * 100.0);  // bound over 1 / (4 R^2)
    ASSERT_LT(share, 0.5);
    EXPECT_LE(std::abs(deviation(rendering, "indirect", 0, share * expected).mean), 2e-3);
}

}  // namespace
}  // namespace weft::vpl_sphere_test
