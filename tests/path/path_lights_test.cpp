// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/testing/floor_scenes.h"
#include "tests/testing/path_fixture.h"

// Direct light of path tracing against closed forms: every kind of light at points of a floor, and
// form factors of squares.
//
// An image of 16 x 16 pixels shows one point of the floor. Its mean of 65,536 samples is compared
// with the closed form by its standard error from the scatter of the 256 pixels; the limit is that
// of 300 comparisons (sidak_limit: about 5.1 standard errors), more than this file makes, and the
// standard error itself must be small. Lights without an area have no variance and are compared
// exactly.
namespace weft::path_lights_test {
namespace {

using test::area_light_mesh;
using test::corners_of;
using test::eye_offset;
using test::floor_scene;
using test::polygon_irradiance;
using test::radiance;
using test::receiver_albedo;
using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;
constexpr std::size_t comparisons = 300;

PathSettings direct_only(std::uint32_t edge, std::uint32_t samples, std::uint32_t seed = 0) {
    PathSettings settings = test::path_settings(edge, edge, samples, seed);
    settings.indirect = false;
    return settings;
}

void expect_sampled(TestBackend backend, const Scene& scene, const glm::dvec3& point,
                    const glm::dvec3& expected, double bias = 0.0,
                    const glm::dvec3& eye = eye_offset) {
    const Rendering rendering = test::path_image(
        backend, scene, test::look_at(point + eye, point, 0.001), direct_only(16, 256));
    for (std::uint32_t c = 0; c < 3; ++c) {
        const auto k = static_cast<glm::length_t>(c);
        const double share = static_cast<double>(receiver_albedo[k]) / pi;
        // The footprint's edge of 2e-4 shifts the mean by its square.
        test::expect_estimate(test::layer_of(rendering, "direct", c), share * expected[k],
                              {comparisons, 0.012, bias + 1e-5},
                              std::string(test::backend_name(backend)) + " channel " +
                                  std::to_string(c) + " at " + std::to_string(point.x));
    }
}

void expect_exact(TestBackend backend, const Scene& scene, const glm::dvec3& point,
                  const glm::dvec3& expected, double absolute = 0.0) {
    PathSettings settings = direct_only(1, 3);
    settings.through_centres = true;
    const Rendering rendering =
        test::path_image(backend, scene, test::look_at(point + eye_offset, point, 0.001), settings);
    for (std::uint32_t c = 0; c < 3; ++c)
        EXPECT_NEAR(rendering.irradiance("direct", 0, 0, c),
                    expected[static_cast<glm::length_t>(c)],
                    5e-6 * expected[static_cast<glm::length_t>(c)] + absolute)
            << test::backend_name(backend) << " channel " << c;
}

TEST(PathLights, SquareLightGivesLambertsIrradiance) {
    SceneBuilder builder = floor_scene();
    builder.add(area_light_mesh(), builder.material(glm::vec3(0.5F), radiance));
    for (const TestBackend backend : test::light_backends()) {
        expect_sampled(backend, builder.scene, {0, 0, 0}, 0.7522746885 * glm::dvec3(radiance));
        expect_sampled(backend, builder.scene, {1, 0, 0}, 0.2650048523 * glm::dvec3(radiance));
    }
}

TEST(PathLights, TexturedLightsShineWhereTheirTextureIsBright) {
    const Scene scene = test::half_bright_square();
    for (const TestBackend backend : test::light_backends())
        for (const glm::dvec3& point : {glm::dvec3(0, 0, 0), glm::dvec3(-0.7, 0.4, 0)})
            expect_sampled(backend, scene, point, test::half_bright_irradiance(point));
}

TEST(PathLights, NearAndFarSquaresAreSampledAlikeWell) {
    // Close to a light scattered rays do better, far from it its samples do: both must be weighted.
    for (const double height : {0.01, 0.1, 10.0, 1000.0}) {
        const auto h = static_cast<float>(height);
        const Mesh area_light = test::quad_mesh({-0.5F, -0.5F, h}, {0, 1, 0}, {1, 0, 0});
        SceneBuilder builder = floor_scene();
        builder.add(area_light, builder.material(glm::vec3(0.0F), radiance));
        expect_sampled(TestBackend::own_bvh, builder.scene, {0.1, 0.2, 0},
                       polygon_irradiance(corners_of(area_light), {0.1, 0.2, 0}, {0, 0, 1}) *
                           glm::dvec3(radiance),
                       0.0, std::min(1.0, 2.0 * height) * eye_offset);
    }
}

TEST(PathLights, TiltedParallelogramsOfTwoSides) {
    for (const Mesh& quad : test::tilted_parallelograms()) {
        SceneBuilder builder = floor_scene();
        const std::uint32_t material = builder.material(glm::vec3(0.5F), radiance);
        builder.scene.materials[material].emission.both_sides = true;
        builder.add(quad, material);
        for (const TestBackend backend : test::light_backends())
            for (const glm::dvec3& point : {glm::dvec3(0, 0, 0), glm::dvec3(-0.7, 0.4, 0)})
                expect_sampled(
                    backend, builder.scene, point,
                    polygon_irradiance(corners_of(quad), point, {0, 0, 1}) * glm::dvec3(radiance));
    }
}

TEST(PathLights, OneSidedEmittersShineToTheirFrontOnly) {
    SceneBuilder builder = floor_scene();
    builder.add(test::quad_mesh({-3, -3, 2}, {0, 6, 0}, {6, 0, 0}),
                builder.material(receiver_albedo));
    const std::uint32_t area_light = builder.material(glm::vec3(0.0F), radiance);
    builder.add(area_light_mesh(), area_light);
    const glm::dvec3 full = 0.7522746885 * glm::dvec3(radiance);
    const glm::dvec3 eye(0.05, -0.1, -0.2);
    for (const TestBackend backend : test::light_backends()) {
        builder.scene.materials[area_light].emission.both_sides = false;
        const Rendering dark = test::path_image(backend, builder.scene,
                                                test::look_at({0.05, -0.1, 1.8}, {0, 0, 2}, 0.001),
                                                direct_only(4, 64));
        for (const float value : dark.layer("direct")) EXPECT_EQ(value, 0.0F);
        expect_sampled(backend, builder.scene, {0, 0, 0}, full);
        builder.scene.materials[area_light].emission.both_sides = true;
        expect_sampled(backend, builder.scene, {0, 0, 2}, full, 0.0, eye);
    }
}

TEST(PathLights, DiskOnAxis) {
    const test::LitFloor floor = test::disk_over_floor();
    for (const TestBackend backend : test::light_backends())
        expect_sampled(backend, floor.scene, {0, 0, 0}, floor.irradiance, floor.bias);
}

TEST(PathLights, SphereAboveTheHorizon) {
    const test::LitFloor floor = test::sphere_over_floor();
    for (const TestBackend backend : test::light_backends())
        expect_sampled(backend, floor.scene, {0, 0, 0}, floor.irradiance, floor.bias);
}

TEST(PathLights, PointLightIsExact) {
    const double height = 1.7;
    SceneBuilder builder = floor_scene();
    builder.light(LightType::point, {0.2, 0.1, height}, radiance);
    for (const TestBackend backend : test::light_backends())
        for (const glm::dvec3& point :
             {glm::dvec3(0.2, 0.1, 0), glm::dvec3(-1.0, 0.5, 0), glm::dvec3(2.9, -2.8, 0)}) {
            const glm::dvec3 d = glm::dvec3(0.2, 0.1, height) - point;
            const double cosine = height / glm::length(d);
            expect_exact(backend, builder.scene, point,
                         std::pow(cosine, 3.0) / (height * height) * glm::dvec3(radiance));
        }
    builder.scene.lights[0].position.z = -height;
    expect_exact(TestBackend::own_bvh, builder.scene, {0, 0, 0}, glm::dvec3(0.0));
}

TEST(PathLights, SpotFallsOffBetweenItsCones) {
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
            const double falloff = std::pow(std::clamp((cosine - 0.7) / 0.2, 0.0, 1.0), 2.0);
            // Near the edge the difference of cosines cancels.
            expect_exact(backend, builder.scene, point,
                         falloff * std::pow(cosine, 3.0) / (height * height) * glm::dvec3(radiance),
                         2e-5 * std::sqrt(falloff));
        }
}

TEST(PathLights, SpotOfALinearEdgeFallsOffWithTheAngle) {
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
        for (const double angle : {0.0, 0.29, 0.4, 0.5, 0.65, 0.699, 0.701, 1.0}) {
            SCOPED_TRACE(angle);
            const glm::dvec3 point(height * std::tan(angle), 0.0, 0.0);
            const double falloff = std::clamp((outer - angle) / (outer - inner), 0.0, 1.0);
            // Near the edge the difference of angles cancels.
            expect_exact(
                backend, builder.scene, point,
                falloff * std::pow(std::cos(angle), 3.0) / (height * height) * glm::dvec3(radiance),
                falloff > 0.0 ? 5e-6 : 0.0);
        }
}

TEST(PathLights, DirectionalLightIsExactAndCastsShadows) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.6, 0.2, -1.0));
    SceneBuilder builder = floor_scene();
    builder.light(LightType::directional, {}, radiance, direction);
    builder.add(test::quad_mesh({-0.5F, -0.5F, 1.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}),
                builder.material(glm::vec3(0.5F)));
    // The square's shadow is moved by (0.6, 0.2): its corners from (0.1, -0.3) to (1.1, 0.7).
    for (const TestBackend backend : test::light_backends()) {
        for (const glm::dvec3& dark : {glm::dvec3(0.11, -0.29, 0), glm::dvec3(1.09, 0.69, 0)})
            expect_exact(backend, builder.scene, dark, glm::dvec3(0.0));
        for (const glm::dvec3& lit : {glm::dvec3(0.09, -0.29, 0), glm::dvec3(1.11, 0.69, 0)})
            expect_exact(backend, builder.scene, lit, -direction.z * glm::dvec3(radiance));
    }
}

TEST(PathLights, EnvironmentOverAnOpenPlaneAndBehindASquare) {
    SceneBuilder builder = floor_scene();
    builder.scene.environment = Environment{radiance};
    for (const TestBackend backend : test::light_backends())
        expect_exact(backend, builder.scene, {0, 0, 0}, pi * glm::dvec3(radiance));
    builder.add(area_light_mesh(), builder.material(glm::vec3(0.5F)));
    for (const TestBackend backend : test::light_backends())
        expect_sampled(backend, builder.scene, {0, 0, 0},
                       (pi - 0.7522746885) * glm::dvec3(radiance));
}

TEST(PathLights, HalfPlaneCastsTheExactPenumbra) {
    // A half plane at height 1/2 over x > 0.1 hides the area light's x > 0.2 - p from the point p:
    // the penumbra reaches from -0.3 to 0.7.
    SceneBuilder builder = floor_scene();
    builder.add(area_light_mesh(), builder.material(glm::vec3(0.5F), radiance));
    builder.add(test::quad_mesh({0.1F, -5.0F, 0.5F}, {5.0F, 0.0F, 0.0F}, {0.0F, 10.0F, 0.0F}),
                builder.material(glm::vec3(0.0F)));
    for (const double p : {-0.6, -0.31, -0.29, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5}) {
        const double x = std::min(0.5, 0.2 - p);
        const std::vector<glm::dvec3> visible{
            {-0.5, -0.5, 1.0}, {-0.5, 0.5, 1.0}, {x, 0.5, 1.0}, {x, -0.5, 1.0}};
        const double expected = polygon_irradiance(visible, {p, 0, 0}, {0, 0, 1});
        for (const TestBackend backend : test::light_backends())
            if (backend == TestBackend::own_bvh || p == 0.1)
                expect_sampled(backend, builder.scene, {p, 0, 0}, expected * glm::dvec3(radiance));
    }
    for (const TestBackend backend : test::light_backends())
        expect_exact(backend, builder.scene, {0.71, 0, 0}, glm::dvec3(0.0));
}

TEST(PathLights, ManyFaintAreaLightsBesideASun) {
    const test::LitFloor lit = test::faint_area_lights_beside_a_sun();
    // The sums count 2^-52 of the sun, so that a sample of an area light is rounded to about 1e-3
    // of it, up as often as down.
    for (const TestBackend backend : test::light_backends())
        expect_sampled(backend, lit.scene, {0, 0, 0}, lit.irradiance, 1e-4);
}

TEST(PathLights, ShadingNormalsTurnTheCosineButNotTheHorizon) {
    // A floor whose normals lean by 40 degrees. Lights above it count with the leaning cosine; of
    // the environment about the leaning normal (1 + cos) / 2 lies above the floor, and what would
    // go below it must not come back as indirect light.
    const double lean = 40.0 * pi / 180.0;
    const glm::dvec3 normal(std::sin(lean), 0.0, std::cos(lean));
    const auto scene = [&] {
        SceneBuilder builder = floor_scene();
        builder.scene.meshes[0].normals.assign(4, glm::vec3(normal));
        return builder;
    };
    SceneBuilder point = scene();
    point.light(LightType::point, {1.0, 0.2, 0.7}, radiance);
    SceneBuilder hidden = scene();
    hidden.light(LightType::point, {-2.0, 0.0, 1.0}, radiance);  // behind the leaning normal
    SceneBuilder area_light = scene();
    area_light.add(area_light_mesh(), area_light.material(glm::vec3(0.5F), radiance));
    SceneBuilder sky = scene();
    sky.scene.environment = Environment{radiance};
    const glm::dvec3 d(1.0, 0.2, 0.7);
    const glm::dvec3 by_area_light =
        polygon_irradiance(corners_of(area_light_mesh()), {0, 0, 0}, normal) * glm::dvec3(radiance);
    for (const TestBackend backend : test::light_backends()) {
        expect_exact(backend, point.scene, {0, 0, 0},
                     glm::dot(d, normal) / std::pow(glm::length(d), 3.0) * glm::dvec3(radiance));
        expect_exact(backend, hidden.scene, {0, 0, 0}, glm::dvec3(0.0));
        expect_sampled(backend, area_light.scene, {0, 0, 0}, by_area_light);
        const Rendering all =
            test::path_image(backend, sky.scene, test::look_at(eye_offset, {0, 0, 0}, 0.001),
                             test::path_settings(16, 16, 256));
        for (std::uint32_t c = 0; c < 3; ++c) {
            const auto k = static_cast<glm::length_t>(c);
            const double full = double{receiver_albedo[k]} * double{radiance[k]};
            test::expect_estimate(test::beauty_of(all, c), full * 0.5 * (1.0 + std::cos(lean)),
                                  {comparisons, 0.004, 1e-5},
                                  std::string(test::backend_name(backend)) + " sky");
        }
        for (const float value : all.layer("indirect")) ASSERT_EQ(value, 0.0F);
    }
}

TEST(PathLights, PixelsAverageOverTheirBox) {
    // An area light that covers 0.3 x 0.6 of a pixel from its left lower corner, or has its edge at
    // the centre's left or right.
    const auto image = [](float left, float bottom, bool centres, std::uint32_t samples) {
        SceneBuilder builder;
        builder.add(test::quad_mesh({left - 2.0F, bottom - 2.0F, 0}, {2, 0, 0}, {0, 2, 0}),
                    builder.material(glm::vec3(0.0F), radiance));
        PathSettings settings = test::path_settings(2, 2, samples, 3);
        settings.through_centres = centres;
        // The image shows [-1, 1]^2: pixel (0, 1) is [-1, 0]^2.
        return test::path_image(TestBackend::own_bvh, builder.scene,
                                test::look_at({0, 0, 1}, {0, 0, 0}, pi / 2.0), settings);
    };
    const Rendering box = image(-0.7F, -0.4F, false, 200'000);
    test::expect_estimate({box.at("", 0, 1), std::sqrt(double(box.at("variance", 0, 1)))}, 0.18,
                          {comparisons, 0.006, 1e-5}, "coverage");
    for (const auto& [x, y] : {std::pair{0U, 0U}, std::pair{1U, 0U}, std::pair{1U, 1U}})
        EXPECT_EQ(box.at("", x, y), 0.0F);
    EXPECT_EQ(image(-0.501F, -0.1F, true, 4).at("", 0, 1), 0.0F);
    EXPECT_EQ(image(-0.499F, -0.1F, true, 4).at("", 0, 1), 1.0F);
    EXPECT_EQ(image(-0.1F, -0.501F, true, 4).at("", 0, 1), 0.0F);
    EXPECT_EQ(image(-0.1F, -0.499F, true, 4).at("", 0, 1), 1.0F);
}

/// The square [0, 1]^2 in z = 0, which faces up and fills the image, and area lights of radiance 1.
test::Estimate form_factor(TestBackend backend, const std::vector<Mesh>& area_lights) {
    SceneBuilder builder;
    builder.add(test::quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                builder.material(glm::vec3(1.0F)));
    const std::uint32_t material = builder.material(glm::vec3(0.0F), glm::vec3(1.0F));
    for (const Mesh& area_light : area_lights) builder.add(area_light, material);
    // From half way up an image of 90 degrees shows the square evenly; the box filter integrates
    // over all of it.
    return test::beauty_of(
        test::path_image(backend, builder.scene,
                         test::look_at({0.5, 0.5, 0.5}, {0.5, 0.5, 0.0}, pi / 2.0),
                         direct_only(32, 256)),
        0);
}

const Mesh& opposite() {
    static const Mesh mesh = test::quad_mesh({0, 0, 1}, {0, 1, 0}, {1, 0, 0});
    return mesh;
}

std::vector<Mesh> walls() {
    return {test::quad_mesh({0, 0, 0}, {0, 1, 0}, {0, 0, 1}),
            test::quad_mesh({1, 0, 0}, {0, 0, 1}, {0, 1, 0}),
            test::quad_mesh({0, 0, 0}, {0, 0, 1}, {1, 0, 0}),
            test::quad_mesh({0, 1, 0}, {1, 0, 0}, {0, 0, 1})};
}

TEST(PathLights, FormFactorsOfSquares) {
    const test::Tolerance tolerance{comparisons, 3e-3, 1e-6};
    for (const TestBackend backend : test::light_backends()) {
        test::expect_estimate(form_factor(backend, {opposite()}), 0.1998248957, tolerance,
                              "parallel");
        // Squares with a common edge are hard: near it their samples are of unbounded value.
        for (const Mesh& wall : walls())
            test::expect_estimate(form_factor(backend, {wall}), 0.2000437761, tolerance,
                                  "perpendicular");
    }
}

TEST(PathLights, FormFactorsAddUpToOne) {
    std::vector<Mesh> all = walls();
    all.push_back(opposite());
    for (const TestBackend backend : test::light_backends())
        test::expect_estimate(form_factor(backend, all), 1.0, {comparisons, 2e-3, 1e-6}, "closure");
}

}  // namespace
}  // namespace weft::path_lights_test
