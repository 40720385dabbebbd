// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plan/algorithm.h"
#include "tests/testing/closed_forms.h"
#include "tests/testing/floor_scenes.h"
#include "tests/testing/render_fixture.h"

// Receivers so close to an area light that the bound on its samples would leave most of its light
// out, at the settings of previews. Images of one pixel show a floor's point at the foot of an area
// light that stands on the floor, from behind the area light's dark back or from the side.
namespace weft::analytic_area_light_test {
namespace {

using test::polygon_irradiance;
using test::radiance;
using test::SceneBuilder;
using test::TestBackend;

const glm::dvec3 up(0.0, 0.0, 1.0);
const glm::dvec3 foot(0.0, 0.0, 0.0);

/// The part y < `end` of an area light of edge 1 that stands at x = `distance` and shines to -x.
std::vector<glm::dvec3> standing_lamp(double distance, double end = 0.5) {
    return {
        {distance, -0.5, 0.0}, {distance, end, 0.0}, {distance, end, 1.0}, {distance, -0.5, 1.0}};
}

SceneBuilder beside_area_light(float distance, bool both_sides = false) {
    SceneBuilder builder = test::floor_scene();
    const std::uint32_t area_light = builder.material(glm::vec3(0.0F), radiance);
    builder.scene.materials[area_light].emission.both_sides = both_sides;
    builder.add(test::quad_mesh({distance, -0.5F, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}),
                area_light);
    return builder;
}

RenderSettings one_pixel(Algorithm algorithm, std::uint32_t seed) {
    RenderSettings settings = test::small_settings(algorithm, 1, 1);
    settings.indirect = false;
    settings.seed = seed;
    return settings;
}

double irradiance_at_foot(TestBackend backend, const Scene& scene, const RenderSettings& settings) {
    validate_scene(scene);
    const test::Rendering rendering =
        test::render_flat(test::shared_executor(backend), flatten(scene),
                          test::look_at({-0.2, -0.1, 0.3}, foot, 0.001), settings);
    test::expect_clean(rendering);
    return rendering.irradiance("direct", 0, 0) / static_cast<double>(radiance.x);
}

TEST(AnalyticAreaLight, UnhiddenItGivesLambertsIrradiance) {
    for (const TestBackend backend : test::backends())
        for (const Algorithm algorithm : {Algorithm::ais, Algorithm::amax, Algorithm::igi})
            for (const float distance : {1e-4F, 1e-3F, 0.01F, 0.1F}) {
                SCOPED_TRACE(distance);
                const double expected =
                    polygon_irradiance(standing_lamp(static_cast<double>(distance)), foot, up);
                // Rounding, and a pixel of 0.001 rad at a distance of 0.37 is 0.0004 wide: the
                // image shows a point somewhere in it.
                const double moved = polygon_irradiance(
                    standing_lamp(static_cast<double>(distance) + 3e-4), foot, up);
                EXPECT_NEAR(irradiance_at_foot(backend, beside_area_light(distance).scene,
                                               one_pixel(algorithm, 0)),
                            expected, std::abs(expected - moved) + 2e-5 * expected)
                    << test::backend_name(backend) << ' '
                    << algorithm_names.at(static_cast<std::size_t>(algorithm));
            }
}

TEST(AnalyticAreaLight, AnAreaLightThatShinesToBothSidesDoesSoNearby) {
    for (const float distance : {0.01F, 0.1F}) {
        const double expected =
            polygon_irradiance(standing_lamp(static_cast<double>(distance)), foot, up);
        // The side of a sample is drawn by chance: sets none of whose samples faces the receiver
        // add nothing, and the others make up for them.
        double sum = 0.0;
        constexpr std::uint32_t seeds = 64;
        for (std::uint32_t seed = 0; seed < seeds; ++seed)
            sum += irradiance_at_foot(TestBackend::own_bvh, beside_area_light(distance, true).scene,
                                      one_pixel(Algorithm::amax, seed));
        EXPECT_NEAR(sum / seeds, expected, 0.01 * expected) << distance;
    }
}

/// Mean over seeds of the irradiance that comes past a screen, from the part of the area light
/// where y < `edge`.
test::Estimate light_past_screen(float distance, float edge) {
    std::vector<double> values;
    SceneBuilder builder = beside_area_light(distance);
    builder.add(test::quad_mesh({0.5F * distance, 0.5F * edge, 0.0F}, {0.0F, 2.0F, 0.0F},
                                {0.0F, 0.0F, 2.0F}),
                builder.material(glm::vec3(0.0F)));
    for (std::uint32_t seed = 0; seed < 256; ++seed)
        values.push_back(irradiance_at_foot(TestBackend::own_bvh, builder.scene,
                                            one_pixel(Algorithm::amax, seed)));
    return test::estimate(values);
}

// Of four samples few lie where most of the light comes from, and their weights are bounded: what
// is hidden counts by something between its light and its area. Intervals are of 5 standard errors,
// 256 seeds each; a correct renderer fails one such comparison in a million.
TEST(AnalyticAreaLight, AScreenHidesBetweenTheShareOfLightAndThatOfArea) {
    for (const float distance : {0.03F, 0.1F, 0.2F})
        for (const float edge : {-0.1F, 0.0F, 0.1F}) {
            const auto area_light = [&](double end) {
                return polygon_irradiance(standing_lamp(static_cast<double>(distance), end), foot,
                                          up);
            };
            const double light = area_light(static_cast<double>(edge)) / area_light(0.5);
            const double area = static_cast<double>(edge) + 0.5;
            const auto [mean, error] = light_past_screen(distance, edge);
            const double share = mean / area_light(0.5);
            const double slack = 5.0 * error / area_light(0.5);
            EXPECT_LT(slack, 0.13);
            EXPECT_GE(share, std::min(light, area) - slack) << distance << ' ' << edge;
            EXPECT_LE(share, std::max(light, area) + slack) << distance << ' ' << edge;
        }
}

}  // namespace
}  // namespace weft::analytic_area_light_test
