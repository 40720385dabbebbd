// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "selftest/case_groups.h"
#include "selftest/floor_light.h"
#include "selftest/smooth_ball.h"

// Lights without area, whose light is exact, from above and at grazing angles.
namespace weft::selftest {
namespace {

// Least cosine between the floor's normal and the direction to a light.
constexpr double grazing = 1e-3;

/// I cos^3 / h^2 (Lambert).
double point_irradiance(const glm::dvec3& light, const glm::dvec3& point) {
    const glm::dvec3 d = light - point;
    const double distance = glm::length(d);
    return d.z / (distance * distance * distance);
}

FlatScene under_point(const glm::dvec3& light) {
    SceneBuilder builder = floor_scene();
    builder.light(LightType::point, light, glm::vec3(1.0F));
    return flatten(builder.scene);
}

SelftestCase point_light() {
    const glm::dvec3 light(0.2, 0.1, 1.7);
    const glm::dvec3 below(0.2, 0.1, 0.0);
    const glm::dvec3 corner(2.9, -2.8, 0.0);
    const std::string rounding =
        "some half ulps, and up to 24 of the scene's extent that shadow rays start above surfaces";
    return {10,
            "point light over a plane",
            RunsOn::devices,
            {{"below it", point_irradiance(light, below), share(5e-6), rounding},
             {"far from it", point_irradiance(light, corner), share(5e-6), rounding},
             {"far from it, paths", point_irradiance(light, corner), share(5e-6), rounding}},
            [=](Executor& executor) -> std::vector<Measured> {
                const FlatScene flat = under_point(light);
                PathSettings settings = path_settings(1, 1, 3);
                settings.through_centres = true;
                const Rendering traced = trace_flat(executor, flat, camera_on(corner), settings);
                return {exact_irradiance(executor, flat, below),
                        exact_irradiance(executor, flat, corner),
                        traced.irradiance("direct", 0, 0)};
            }};
}

/// Measures direct light of the smooth ball: number of pixels that are brighter than their
/// neighbour on the side of the light; largest difference from the image in doubles; and largest
/// cosine of the smooth normal, by the image's own normals, at a pixel that is dark all the same.
std::vector<Measured> measure_ball(Executor& executor) {
    const SmoothBall ball = smooth_ball();
    RenderSettings settings = small_settings(Algorithm::ir, ball_width, ball_height);
    settings.indirect = false;
    const Rendering rendering = render(executor, ball.scene, ball.camera, settings);
    const glm::dvec3 light = -ball.scene.lights.front().direction;
    double brighter = 0.0;
    double farthest = 0.0;
    double block = 0.0;
    for (std::uint32_t y = 0; y < ball_height; ++y)
        for (std::uint32_t x = 0; x < ball_width; ++x) {
            const BallPixel& pixel = ball_pixels()[std::size_t{y} * ball_width + x];
            const float found = rendering.at("direct", x, y);
            if (x > 0 && rendering.at("depth", x - 1, y) > 0.0F &&
                rendering.at("depth", x, y) > 0.0F)
                brighter += found > rendering.at("direct", x - 1, y) * 1.00001F ? 1.0 : 0.0;
            if (pixel.undecided) continue;
            farthest = std::max(farthest, std::abs(static_cast<double>(found) - pixel.radiance));
            if (!pixel.on_ball || found > 0.0F) continue;
            const glm::dvec3 normal(rendering.at("normal", x, y, 0),
                                    rendering.at("normal", x, y, 1),
                                    rendering.at("normal", x, y, 2));
            block = std::max(block, glm::dot(normal, light));
        }
    // In a black image no pixel would be brighter than another.
    if (!(mean_of(rendering.layer("direct")) > 0.0)) brighter = NAN;
    return {brighter, farthest, block};
}

SelftestCase grazing_light() {
    const double sine = std::sqrt(1.0 + grazing * grazing);
    return {20,
            "grazing light",
            RunsOn::devices,
            {{"directional light, cosine 1e-3", grazing / sine, share(2e-5),
              "roundings of direction and normal, beside a cosine of 1e-3"},
             {"point light, cosine 1e-3", grazing / (sine * sine * sine), share(5e-3),
              "shadow rays start up to 2e-6 above the floor, beside a height of 1e-3"},
             {"coarse smooth ball, pixels out of order", 0.0, within(0.0),
              "rows fall from the side of the light; facets end it where their planes do"},
             {"coarse smooth ball, pixel farthest off", 0.0, within(3e-7),
              "an eighth of light at most, rounded; no facet shadows another, nor itself"},
             {"coarse smooth ball, cosine of its largest block", largest_block(), within(1e-6),
              "facets that face away are dark although their smooth normals are not"}},
            [](Executor& executor) -> std::vector<Measured> {
                SceneBuilder sun = floor_scene();
                sun.light(LightType::directional, {}, glm::vec3(1.0F), {1.0, 0.0, -grazing});
                std::vector<Measured> measured{
                    exact_irradiance(executor, flatten(sun.scene), {0.0, 0.0, 0.0}),
                    exact_irradiance(executor, under_point({1.0, 0.0, grazing}), {0.0, 0.0, 0.0})};
                std::ranges::move(measure_ball(executor), std::back_inserter(measured));
                return measured;
            }};
}

}  // namespace

std::vector<SelftestCase> exact_light_cases() {
    return {point_light(), grazing_light()};
}

}  // namespace weft::selftest
