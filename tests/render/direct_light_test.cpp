// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/testing/closed_forms.h"
#include "tests/testing/floor_scenes.h"
#include "tests/testing/render_fixture.h"

// Direct light against closed forms, through the kernels that make images: an image of one pixel
// shows the receiver's point, and its direct layer is albedo / pi times the irradiance.
//
// What is sampled is rendered with 16 seeds of 9216 samples each; their mean must lie within 5
// standard errors of the closed form, estimated from the 16 values (Student's t with 15 degrees of
// freedom: a correct renderer fails one such comparison in 6,000, and seeds are fixed), and the
// standard error itself must be small, or the test would accept anything.
namespace weft::direct_light_test {
namespace {

using test::area_light_mesh;
using test::corners_of;
using test::eye_offset;
using test::floor_scene;
using test::polygon_irradiance;
using test::radiance;
using test::receiver_albedo;
using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t seeds = 16;

RenderSettings one_pixel(std::uint32_t seed) {
    RenderSettings settings = test::unbounded(test::small_settings(Algorithm::ir, 1, 1));
    settings.sampling.samples_per_light = 1024;
    settings.sampling.max_samples_per_set = 4096;
    settings.indirect = false;
    settings.seed = seed;
    return settings;
}

/// Irradiance by direct light at `point` of a surface, seen from `eye`.
glm::dvec3 irradiance_at(TestBackend backend, const FlatScene& flat, const glm::dvec3& point,
                         const glm::dvec3& eye, std::uint32_t seed) {
    const test::Rendering rendering = test::render_flat(
        test::shared_executor(backend), flat, test::look_at(eye, point, 0.001), one_pixel(seed));
    test::expect_clean(rendering);
    glm::dvec3 result(0.0);
    for (std::uint32_t c = 0; c < 3; ++c)
        result[static_cast<glm::length_t>(c)] = rendering.irradiance("direct", 0, 0, c);
    return result;
}

glm::dvec3 floor_irradiance(TestBackend backend, const Scene& scene, const glm::dvec3& point) {
    validate_scene(scene);
    return irradiance_at(backend, flatten(scene), point, point + eye_offset, 0);
}

/// The comparison described above; `bias` is what the model itself is off by, relative.
void expect_sampled(TestBackend backend, const Scene& scene, const glm::dvec3& point,
                    const glm::dvec3& expected, double bias = 0.0,
                    const glm::dvec3& eye = eye_offset) {
    validate_scene(scene);
    const FlatScene flat = flatten(scene);
    std::vector<glm::dvec3> values;
    for (std::uint32_t seed = 0; seed < seeds; ++seed)
        values.push_back(irradiance_at(backend, flat, point, point + eye, seed));
    for (int c = 0; c < 3; ++c) {
        std::vector<double> channel;
        for (const glm::dvec3& value : values) channel.push_back(value[c]);
        const auto [mean, error] = test::estimate(channel);
        EXPECT_LE(error, 1e-3 * expected[c]);
        EXPECT_NEAR(mean, expected[c], 5.0 * error + (bias + 2e-6) * expected[c])
            << test::backend_name(backend) << " channel " << c;
    }
}

TEST(DirectLight, TheFormulaGivesThePublishedValues) {
    const auto square = corners_of(area_light_mesh());
    EXPECT_NEAR(polygon_irradiance(square, {0, 0, 0}, {0, 0, 1}), 0.7522746885, 1e-10);
    EXPECT_NEAR(polygon_irradiance(square, {1, 0, 0}, {0, 0, 1}), 0.2650048523, 1e-10);
}

TEST(DirectLight, SquareLightGivesLambertsIrradiance) {
    SceneBuilder builder = floor_scene();
    builder.add(area_light_mesh(), builder.material(glm::vec3(0.5F), radiance));
    for (const TestBackend backend : test::light_backends()) {
        expect_sampled(backend, builder.scene, {0, 0, 0}, 0.7522746885 * glm::dvec3(radiance));
        expect_sampled(backend, builder.scene, {1, 0, 0}, 0.2650048523 * glm::dvec3(radiance));
    }
}

TEST(DirectLight, TexturedLightsShineWhereTheirTextureIsBright) {
    const Scene scene = test::half_bright_square();
    for (const TestBackend backend : test::light_backends())
        for (const glm::dvec3& point : {glm::dvec3(0, 0, 0), glm::dvec3(-0.7, 0.4, 0)})
            expect_sampled(backend, scene, point, test::half_bright_irradiance(point));
}

TEST(DirectLight, TiltedParallelogramsGiveLambertsIrradiance) {
    for (const Mesh& quad : test::tilted_parallelograms()) {
        SceneBuilder builder = floor_scene();
        const std::uint32_t material = builder.material(glm::vec3(0.5F), radiance);
        builder.scene.materials[material].emission.both_sides = true;
        builder.add(quad, material);
        for (const glm::dvec3& point : {glm::dvec3(0, 0, 0), glm::dvec3(-0.7, 0.4, 0)})
            expect_sampled(
                TestBackend::own_bvh, builder.scene, point,
                polygon_irradiance(corners_of(quad), point, {0, 0, 1}) * glm::dvec3(radiance));
    }
}

TEST(DirectLight, FaintAreaLightsBesideASunAreSampledByTheirOwnPowers) {
    // Too many lights for samples of each.
    const test::LitFloor lit = test::faint_area_lights_beside_a_sun();
    for (const TestBackend backend : test::light_backends())
        expect_sampled(backend, lit.scene, {0, 0, 0}, lit.irradiance);
}

TEST(DirectLight, AnOccluderClipsTheLight) {
    // A half plane at height 1/2 over x > 0.1 hides the area light's x > 0.2 from the origin.
    SceneBuilder builder = floor_scene();
    builder.add(area_light_mesh(), builder.material(glm::vec3(0.5F), radiance));
    builder.add(test::quad_mesh({0.1F, -5.0F, 0.5F}, {5.0F, 0.0F, 0.0F}, {0.0F, 10.0F, 0.0F}),
                builder.material(glm::vec3(0.0F)));
    const std::vector<glm::dvec3> left{
        {-0.5, -0.5, 1.0}, {-0.5, 0.5, 1.0}, {0.2, 0.5, 1.0}, {0.2, -0.5, 1.0}};
    const double expected = polygon_irradiance(left, {0, 0, 0}, {0, 0, 1});
    for (const TestBackend backend : test::light_backends())
        expect_sampled(backend, builder.scene, {0, 0, 0}, expected * glm::dvec3(radiance));
    // Wholly hidden and wholly visible points.
    for (const TestBackend backend : test::light_backends()) {
        EXPECT_EQ(floor_irradiance(backend, builder.scene, {2.0, 0, 0}), glm::dvec3(0.0));
        expect_sampled(backend, builder.scene, {-1.0, 0, 0},
                       polygon_irradiance(corners_of(area_light_mesh()), {-1, 0, 0}, {0, 0, 1}) *
                           glm::dvec3(radiance));
    }
}

TEST(DirectLight, DiskOnAxis) {
    const test::LitFloor floor = test::disk_over_floor();
    for (const TestBackend backend : test::light_backends())
        expect_sampled(backend, floor.scene, {0, 0, 0}, floor.irradiance, floor.bias);
}

TEST(DirectLight, SphereAboveTheHorizon) {
    const test::LitFloor floor = test::sphere_over_floor();
    expect_sampled(TestBackend::own_bvh, floor.scene, {0, 0, 0}, floor.irradiance, floor.bias);
}

// Rounding: some half ulps, and the shadow ray's origin, which lies up to 24 half ulps of the
// scene's extent off the surface.
constexpr double exact_tolerance = 5e-6;

void expect_exact(const glm::dvec3& found, const glm::dvec3& expected) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], expected[c], exact_tolerance * expected[c]) << "channel " << c;
}

TEST(DirectLight, PointLightIsExact) {
    const double height = 1.7;
    SceneBuilder builder = floor_scene();
    builder.light(LightType::point, {0.2, 0.1, height}, radiance);
    for (const TestBackend backend : test::light_backends())
        for (const glm::dvec3& point :
             {glm::dvec3(0.2, 0.1, 0), glm::dvec3(-1.0, 0.5, 0), glm::dvec3(2.9, -2.8, 0)}) {
            const glm::dvec3 d = glm::dvec3(0.2, 0.1, height) - point;
            const double cosine = height / glm::length(d);
            expect_exact(floor_irradiance(backend, builder.scene, point),
                         std::pow(cosine, 3.0) / (height * height) * glm::dvec3(radiance));
        }
    // Nothing comes from below the floor.
    builder.scene.lights[0].position.z = -height;
    EXPECT_EQ(floor_irradiance(TestBackend::own_bvh, builder.scene, {0, 0, 0}), glm::dvec3(0.0));
}

TEST(DirectLight, SpotFallsOffBetweenItsConesAndEndsAtTheOuterOne) {
    const double height = 1.5;
    SceneBuilder builder = floor_scene();
    PunctualLight& spot =
        builder.light(LightType::spot, {0.0, 0.0, height}, radiance, {0.0, 0.0, -1.0});
    spot.cos_inner = 0.9F;
    spot.cos_outer = 0.7F;
    for (const TestBackend backend : test::light_backends())
        for (const double cosine : {1.0, 0.95, 0.9001, 0.85, 0.8, 0.71, 0.701, 0.699, 0.5}) {
            SCOPED_TRACE(cosine);
            const glm::dvec3 point(height * std::tan(std::acos(cosine)), 0.0, 0.0);
            const double inside =
                (cosine - static_cast<double>(spot.cos_outer)) /
                (static_cast<double>(spot.cos_inner) - static_cast<double>(spot.cos_outer));
            const double falloff = std::pow(std::clamp(inside, 0.0, 1.0), 2.0);
            const glm::dvec3 found = floor_irradiance(backend, builder.scene, point);
            const glm::dvec3 expected =
                falloff * std::pow(cosine, 3.0) / (height * height) * glm::dvec3(radiance);
            // Near the edge the difference of cosines cancels.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], expected[c],
                            exact_tolerance * expected[c] + 2e-5 * std::sqrt(falloff));
        }
}

TEST(DirectLight, SpotOfALinearEdgeFallsOffWithTheAngle) {
    const double height = 1.5;
    const double inner = 0.3;
    const double outer = 0.7;
    SceneBuilder builder = floor_scene();
    PunctualLight& spot =
        builder.light(LightType::spot, {0.0, 0.0, height}, radiance, {0.0, 0.0, -1.0});
    spot.cos_inner = static_cast<float>(std::cos(inner));
    spot.cos_outer = static_cast<float>(std::cos(outer));
    spot.linear_edge = true;
    for (const TestBackend backend : test::light_backends())
        for (const double angle : {0.0, 0.1, 0.29, 0.4, 0.5, 0.65, 0.699, 0.701, 1.0}) {
            SCOPED_TRACE(angle);
            const glm::dvec3 point(height * std::tan(angle), 0.0, 0.0);
            const double falloff = std::clamp((outer - angle) / (outer - inner), 0.0, 1.0);
            const glm::dvec3 found = floor_irradiance(backend, builder.scene, point);
            const glm::dvec3 expected =
                falloff * std::pow(std::cos(angle), 3.0) / (height * height) * glm::dvec3(radiance);
            // Angles near the edge cancel; those of the cones are rounded as their cosines.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], expected[c],
                            exact_tolerance * expected[c] + (falloff > 0.0 ? 5e-6 : 0.0));
        }
}

TEST(DirectLight, DirectionalLightIsExactAndCastsShadows) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.6, 0.2, -1.0));
    SceneBuilder builder = floor_scene();
    builder.light(LightType::directional, {}, radiance, direction);
    builder.add(test::quad_mesh({-0.5F, -0.5F, 1.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}),
                builder.material(glm::vec3(0.5F)));
    for (const TestBackend backend : test::light_backends()) {
        expect_exact(floor_irradiance(backend, builder.scene, {-0.3, 0.1, 0}),
                     -direction.z * glm::dvec3(radiance));
        // The square's shadow is moved by (0.6, 0.2): its corners from (0.1, -0.3) to (1.1, 0.7).
        for (const glm::dvec3& dark : {glm::dvec3(0.11, -0.29, 0), glm::dvec3(1.09, 0.69, 0)})
            EXPECT_EQ(floor_irradiance(backend, builder.scene, dark), glm::dvec3(0.0));
        for (const glm::dvec3& lit : {glm::dvec3(0.09, -0.29, 0), glm::dvec3(1.11, 0.69, 0)})
            expect_exact(floor_irradiance(backend, builder.scene, lit),
                         -direction.z * glm::dvec3(radiance));
    }
}

TEST(DirectLight, OneSidedEmittersShineToTheirFrontOnly) {
    // Two floors, below and above the area light, which shines down.
    const glm::dvec3 below(0.0, 0.0, 0.0);
    const glm::dvec3 above(0.0, 0.0, 2.0);
    for (const bool both : {false, true}) {
        SceneBuilder builder = floor_scene();
        builder.add(test::quad_mesh({-3, -3, 2}, {0, 6, 0}, {6, 0, 0}),
                    builder.material(receiver_albedo));
        const std::uint32_t area_light = builder.material(glm::vec3(0.0F), radiance);
        builder.scene.materials[area_light].emission.both_sides = both;
        builder.add(area_light_mesh(), area_light);
        const glm::dvec3 full = 0.7522746885 * glm::dvec3(radiance);
        for (const TestBackend backend : test::light_backends()) {
            expect_sampled(backend, builder.scene, below, full);
            const glm::dvec3 eye(0.05, -0.1, -0.2);
            if (both) {
                expect_sampled(backend, builder.scene, above, full, 0.0, eye);
                continue;
            }
            EXPECT_EQ(irradiance_at(backend, flatten(builder.scene), above, above + eye, 3),
                      glm::dvec3(0.0));
        }
        // What the camera sees of the area light.
        for (const double side : {-1.0, 1.0}) {
            const test::Rendering rendering = test::render(
                TestBackend::own_bvh, builder.scene,
                test::look_at({0.0, 0.1, 1.0 + 0.5 * side}, {0.0, 0.0, 1.0}, 0.1), one_pixel(0));
            for (std::uint32_t c = 0; c < 3; ++c)
                EXPECT_EQ(rendering.at("emission", 0, 0, c),
                          side < 0.0 || both ? radiance[static_cast<glm::length_t>(c)] : 0.0F);
        }
    }
}

TEST(DirectLight, EnvironmentOverAnOpenPlaneIsPiTimesItsRadiance) {
    SceneBuilder builder = floor_scene();
    builder.scene.environment = Environment{radiance};
    for (const TestBackend backend : test::light_backends())
        for (const Algorithm algorithm : {Algorithm::igi, Algorithm::ir}) {
            RenderSettings settings = test::small_settings(algorithm, 33, 25);
            const test::Rendering rendering =
                test::render(backend, builder.scene,
                             test::look_at({0.5, -1.0, 2.0}, {0.1, 0.0, 0.0}, 0.6), settings);
            test::expect_clean(rendering);
            for (std::uint32_t y = 0; y < 25; ++y)
                for (std::uint32_t x = 0; x < 33; ++x)
                    for (std::uint32_t c = 0; c < 3; ++c) {
                        const double expected =
                            pi * static_cast<double>(radiance[static_cast<glm::length_t>(c)]);
                        ASSERT_NEAR(rendering.irradiance("direct", x, y, c), expected,
                                    1e-6 * expected);
                    }
        }
}

TEST(DirectLight, EnvironmentBehindASquareLacksTheSquaresShare) {
    SceneBuilder builder = floor_scene();
    builder.scene.environment = Environment{radiance};
    builder.add(area_light_mesh(), builder.material(glm::vec3(0.5F)));
    const glm::dvec3 expected = (pi - 0.7522746885) * glm::dvec3(radiance);
    for (const TestBackend backend : test::light_backends())
        expect_sampled(backend, builder.scene, {0, 0, 0}, expected);
}

TEST(DirectLight, LightsAddUpWhetherAllAreSampledOrSomeAreChosen) {
    // Four area lights of different sizes; below the limit each gets its samples, above it they are
    // chosen by power. The sum is the same.
    SceneBuilder builder = floor_scene();
    double expected = 0.0;
    for (int i = 0; i < 4; ++i) {
        const float edge = 0.2F + 0.2F * static_cast<float>(i);
        const Mesh quad = test::quad_mesh({-1.5F + 0.8F * static_cast<float>(i), -0.3F, 1.2F},
                                          {0.0F, edge, 0.0F}, {edge, 0.0F, 0.0F});
        const float strength = 2.0F - 0.4F * static_cast<float>(i);
        builder.add(quad, builder.material(glm::vec3(0.0F), radiance * strength));
        expected += static_cast<double>(strength) *
                    polygon_irradiance(corners_of(quad), {0, 0, 0}, {0, 0, 1});
    }
    for (const TestBackend backend : test::light_backends())
        expect_sampled(backend, builder.scene, {0, 0, 0}, expected * glm::dvec3(radiance));
    const FlatScene flat = flatten(builder.scene);
    double sum = 0.0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        RenderSettings settings = one_pixel(seed);
        settings.sampling.max_samples_per_set = 2000;
        const test::Rendering rendering =
            test::render_flat(test::shared_executor(TestBackend::own_bvh), flat,
                              test::look_at(eye_offset, {0, 0, 0}, 0.001), settings);
        ASSERT_EQ(rendering.plan.samples_per_light, 0U);
        sum += rendering.irradiance("direct", 0, 0, 0) / seeds;
    }
    // 288,000 samples in all, whose standard deviation is below the value itself: 0.5 % is more
    // than 2.5 standard errors even of independent ones.
    EXPECT_NEAR(sum, expected, 5e-3 * expected);
}

}  // namespace
}  // namespace weft::direct_light_test
