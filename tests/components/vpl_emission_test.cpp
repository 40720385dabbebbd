// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "tests/testing/environment_images.h"
#include "tests/testing/render_fixture.h"

// The flux that every kind of light brings into the VPL walk. Inside a sphere of area A each VPL
// gives its flux / A everywhere, so light of flux P from whatever source gives the indirect
// irradiance (P / A) (rho + rho^2 + ...). Light from infinity is tested with a small receiver over
// a lit floor, whose form factor is known.
namespace weft::vpl_emission_test {
namespace {

using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;
constexpr float rho = 0.5F;
constexpr double orders = 1.0;  // 1/2 + 1/4 + 1/8 + ...
constexpr double four_orders = 0.9375;

double mean_indirect(const Rendering& rendering) {
    double sum = 0.0;
    for (std::uint32_t y = 0; y < rendering.image.height; ++y)
        for (std::uint32_t x = 0; x < rendering.image.width; ++x)
            sum += rendering.irradiance("indirect", x, y);
    return sum / (static_cast<double>(rendering.image.width) * rendering.image.height);
}

/// A unit sphere, looked at from its inside.
SceneBuilder sphere_scene() {
    SceneBuilder builder;
    builder.add(test::icosphere(4, true), builder.material(glm::vec3(rho)));
    return builder;
}

void expect_flux(const SceneBuilder& builder, double flux, double tolerance) {
    const double expected = flux / (4.0 * pi) * orders;
    for (const TestBackend backend : test::light_backends())
        for (const std::uint32_t seed : {0U, 1U}) {
            RenderSettings settings = test::unbounded(test::small_settings(Algorithm::ir, 32, 24));
            settings.direct = false;
            settings.seed = seed;
            const Rendering rendering =
                test::render(backend, builder.scene,
                             test::look_at({0.2, 0.1, 0.3}, {-0.5, -0.4, -0.7}, 1.0), settings);
            test::expect_clean(rendering);
            EXPECT_NEAR(mean_indirect(rendering) / expected, 1.0, tolerance)
                << test::backend_name(backend) << " seed " << seed;
        }
}

// Level 4 facets: 16 times the 5e-4 of level 6 (see vpl_sphere_test.cpp) at worst.
constexpr double facets = 8e-3;

TEST(VplEmission, PointAndSpotLights) {
    SceneBuilder builder = sphere_scene();
    PunctualLight& light =
        builder.light(LightType::point, {0.3, 0.2, -0.4}, glm::vec3(2.0F), {0.6, -0.8, 0.0});
    expect_flux(builder, 4.0 * pi * 2.0, facets);
    // All of the cone at full intensity, but for the falloff over the last 0.001 of the cosine.
    light.type = LightType::spot;
    for (const float edge : {0.9F, -0.5F}) {
        SCOPED_TRACE("cone " + std::to_string(edge));
        light.cos_inner = light.cos_outer = edge;
        expect_flux(builder, 2.0 * pi * 2.0 * (1.0 - static_cast<double>(edge)), facets + 0.01);
    }
}

TEST(VplEmission, SpotLightsOfALinearEdge) {
    // The integral of the falloff is 1 - (sin b - sin a) / (b - a), times 2 pi.
    SceneBuilder builder = sphere_scene();
    PunctualLight& light =
        builder.light(LightType::spot, {0.3, 0.2, -0.4}, glm::vec3(2.0F), {0.6, -0.8, 0.0});
    const double a = 0.4;
    const double b = 1.2;
    light.cos_inner = static_cast<float>(std::cos(a));
    light.cos_outer = static_cast<float>(std::cos(b));
    light.linear_edge = true;
    expect_flux(builder, 2.0 * pi * 2.0 * (1.0 - (std::sin(b) - std::sin(a)) / (b - a)),
                facets + 0.01);
}

TEST(VplEmission, PathsThatSurviveToLateBouncesAreOfAllKinds) {
    // A wide falloff gives paths different weights. The few that survive to the third and fourth
    // bounce must be fair samples of all: if they were the same strata of a dimension in every set
    // and frame, no number of frames would help. The falloff ((c - outer) / (inner - outer))^2
    // integrates to a third of its width.
    SceneBuilder builder;
    builder.add(test::icosphere(3, true), builder.material(glm::vec3(rho)));
    PunctualLight& light =
        builder.light(LightType::spot, {0.3, 0.2, -0.4}, glm::vec3(2.0F), {0.6, -0.8, 0.0});
    light.cos_inner = 0.8F;
    light.cos_outer = 0.2F;
    const double flux = 2.0 * pi * 2.0 * (0.2 + 0.6 / 3.0);
    // These make sets of 35, 40 and 45 paths: multiples of 5, the base of the dimension in which
    // the first direction's cosine counts.
    for (const std::uint32_t vpls : {64U, 75U, 83U})
        for (std::uint32_t seed = 0; seed < 6; ++seed) {
            RenderSettings settings = test::unbounded(test::small_settings(Algorithm::ir, 8, 6));
            settings.direct = false;
            settings.seed = seed;
            settings.sampling.vpls_per_set = vpls;
            settings.sampling.bounces = 4;
            settings.sampling.vpl_tail = false;
            const Rendering rendering =
                test::render(TestBackend::own_bvh, builder.scene,
                             test::look_at({0.2, 0.1, 0.3}, {-0.5, -0.4, -0.7}, 1.0), settings, 24);
            EXPECT_NEAR(mean_indirect(rendering) / (flux / (4.0 * pi) * four_orders), 1.0, 0.02)
                << rendering.plan.paths_per_set << " paths, seed " << seed;
            EXPECT_EQ(rendering.plan.paths_per_set % 5, 0U);
        }
}

TEST(VplEmission, AreaLightsOfOneAndOfTwoSides) {
    // So small an area light hides 1e-4 of the sphere from itself and from others.
    SceneBuilder builder = sphere_scene();
    const std::uint32_t area_light = builder.material(glm::vec3(0.0F), glm::vec3(1000.0F));
    builder.add(test::quad_mesh({0.3F, -0.1F, 0.2F}, {0.02F, 0.01F, 0}, {0, 0.01F, 0.03F}),
                area_light);
    const double area =
        glm::length(glm::cross(glm::dvec3(0.02, 0.01, 0.0), glm::dvec3(0.0, 0.01, 0.03)));
    expect_flux(builder, pi * 1000.0 * area, facets);
    builder.scene.materials[area_light].emission.both_sides = true;
    expect_flux(builder, 2.0 * pi * 1000.0 * area, facets);
}

TEST(VplEmission, SeveralLightsAddUp) {
    // White lights: every path carries the same flux whichever light it comes from.
    SceneBuilder builder = sphere_scene();
    builder.add(test::quad_mesh({0.3F, -0.1F, 0.2F}, {0.02F, 0, 0}, {0, 0.02F, 0}),
                builder.material(glm::vec3(0.0F), glm::vec3(900.0F)));
    builder.add(test::quad_mesh({-0.3F, 0.4F, 0.1F}, {0.03F, 0, 0}, {0, 0, 0.01F}),
                builder.material(glm::vec3(0.0F), glm::vec3(300.0F)));
    builder.light(LightType::point, {0.3, 0.2, -0.4}, glm::vec3(0.7F));
    builder.light(LightType::point, {-0.1, -0.6, 0.1}, glm::vec3(0.02F));
    const double flux = pi * 900.0 * 4e-4 + pi * 300.0 * 3e-4 + 4.0 * pi * 0.7 + 4.0 * pi * 0.02;
    expect_flux(builder, flux, facets);
}

/// Irradiance of a rectangle of radiance 1 in the plane z = 0, at height 1 above its middle, facing
/// down: four times the closed form for a corner.
double floor_share(double half_edge) {
    const double x = half_edge;
    const double root = std::sqrt(1.0 + x * x);
    return 4.0 * (x / root) * std::atan(x / root);
}

/// A floor of edge 4 and a receiver of edge 0.01 above its middle, which is all the camera sees.
SceneBuilder receiver_scene() {
    SceneBuilder builder;
    builder.add(test::quad_mesh({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}),
                builder.material(glm::vec3(rho)));
    builder.add(test::quad_mesh({-0.005F, -0.005F, 1.0F}, {0, 0.01F, 0}, {0.01F, 0, 0}),
                builder.material(glm::vec3(1.0F)));
    return builder;
}

/// The mean over 8 seeds of 32 frames lies within 5 standard errors of `expected`.
void expect_at_receiver(const Scene& scene, double expected) {
    const FlatScene flat = flatten(scene);
    for (const TestBackend backend : test::light_backends()) {
        std::vector<double> values;
        for (std::uint32_t seed = 0; seed < 8; ++seed) {
            RenderSettings settings = test::unbounded(test::small_settings(Algorithm::ir, 1, 1));
            settings.direct = false;
            settings.seed = seed;
            settings.sampling.bounces = 1;
            values.push_back(mean_indirect(test::render_flat(
                test::shared_executor(backend), flat,
                test::look_at({0.1, 0.05, 0.7}, {0.0, 0.0, 1.0}, 1e-3), settings, 32)));
        }
        double mean = 0.0;
        for (const double value : values) mean += value / 8.0;
        double square = 0.0;
        for (const double value : values) square += (value - mean) * (value - mean);
        const double error = std::sqrt(square / (8.0 * 7.0));
        EXPECT_LE(error, 4e-3 * expected);
        EXPECT_NEAR(mean, expected, 5.0 * error + 5e-4 * expected) << test::backend_name(backend);
    }
}

TEST(VplEmission, TheFormFactorIsThatOfFourCorners) {
    // Half an edge of 1/2 at distance 1 is the published unit square below its centre.
    EXPECT_NEAR(floor_share(0.5), 0.7522746885, 1e-9);
}

TEST(VplEmission, DirectionalLight) {
    SceneBuilder builder = receiver_scene();
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.7, 0.3, -1.0));
    builder.light(LightType::directional, {}, glm::vec3(3.0F), direction);
    // The floor's radiance is rho E / pi.
    const double radiance = static_cast<double>(rho) * 3.0 * -direction.z / pi;
    expect_at_receiver(builder.scene, radiance * floor_share(2.0));
}

TEST(VplEmission, Environment) {
    SceneBuilder builder = receiver_scene();
    builder.scene.environment = Environment{glm::vec3(2.0F)};
    // The floor receives pi L from above (the receiver hides 3e-5 of it) and reflects rho L.
    expect_at_receiver(builder.scene, static_cast<double>(rho) * 2.0 * floor_share(2.0));
}

TEST(VplEmission, ImageOfTheEnvironment) {
    // A sky that is brightest at the horizon to one side, standing upright on z.
    const EnvironmentImage image = test::image_of(16, 8, false, [](const glm::dvec3& d) {
        return glm::vec3(static_cast<float>(1.5 + d.x - 0.5 * d.y));
    });
    SceneBuilder builder = receiver_scene();
    builder.scene.environment =
        Environment{glm::vec3(2.0F), std::make_shared<const EnvironmentImage>(image),
                    glm::dmat3{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    const double irradiance = 2.0 * test::irradiance_by(image, {0, 1, 0}, 16).x;
    expect_at_receiver(builder.scene,
                       static_cast<double>(rho) * irradiance / pi * floor_share(2.0));
}

}  // namespace
}  // namespace weft::vpl_emission_test
