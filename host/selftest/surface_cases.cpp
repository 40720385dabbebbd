// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "selftest/case_groups.h"
#include "selftest/floor_light.h"
#include "selftest/floor_scenes.h"
#include "selftest/measurements.h"
#include "selftest/optics_scenes.h"
#include "selftest/path_rendering.h"

#define NATIVE_KERNELS "kernels/bsdf/fresnel.h"
#include "selftest/native_kernels.h"

// Metal, glass and sheets: white ones vanish in white surroundings, glass bends light and lets it
// pass as Snell's law and Fresnel's equations say, mirrors show the unfolded scene.
namespace weft::selftest {
namespace {

/// The mean over a hemisphere of what a dielectric reflects: 2 times the integral of F cos.
double mean_reflectance(double eta) {
    const native::IndexRatio ratio = {static_cast<float>(eta),
                                      static_cast<float>((eta - 1.0) * (eta + 1.0))};
    constexpr int steps = 200'000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        sum += 2.0 * cosine *
               double(native::dielectric_fresnel(ratio, static_cast<float>(cosine)).reflected);
    }
    return sum / steps;
}

SelftestCase fresnel_means() {
    const std::string reason = "floats, of which 200,000 evenly placed ones are the integral";
    return host_case(36, "mean reflectance of dielectrics",
                     {{"index 1.33", 0.0659308, share(2e-6), reason},
                      {"index 1.5", 0.0917780, share(2e-6), reason},
                      {"index 2.42", 0.2125408, share(2e-6), reason},
                      {"index 1.5, from inside", 0.5963458, share(2e-6), reason}},
                     []() -> std::vector<Measured> {
                         return {mean_reflectance(1.33), mean_reflectance(1.5),
                                 mean_reflectance(2.42), mean_reflectance(1.0 / 1.5)};
                     });
}

Rendering in_a_furnace(Executor& executor, const SurfaceDescription& surface,
                       std::uint32_t samples) {
    SceneBuilder builder;
    builder.scene.environment = Environment{glm::vec3(1.0F)};
    builder.add(icosphere(2, false), add_surface(builder, surface));
    return trace_paths(executor, builder.scene, look_at({0, 0, 3}, {0, 0, 0}, 0.6),
                       path_settings(16, 16, samples, 1));
}

SelftestCase white_materials() {
    return {37,
            "white materials in white surroundings",
            RunsOn::devices,
            {{"mirror, worst pixel", 1.0, share(1e-5),
              "every sample has the whole radiance, so only rounding is left"},
             {"rough metal", 1.0, by_chance(2e-3, 5e-3),
              "tables of albedos err to loss, by half a percent at most"},
             {"clear glass of index 1.5", 1.0, by_chance(1e-3, 1e-5),
              "every path has the whole radiance, but for roulette at its length"}},
            [](Executor& executor) -> std::vector<Measured> {
                return {
                    farthest_from(1.0, channel_of(in_a_furnace(executor, metal(0.0F), 2), "", 0)),
                    beauty_of(in_a_furnace(executor, metal(0.4F), 32), 0),
                    beauty_of(in_a_furnace(executor, glass(1.5), 64), 0)};
            }};
}

Estimate by_one_ray(Executor& executor, const Scene& scene, const Camera& camera,
                    std::uint32_t samples, std::uint32_t channel = 0) {
    return beauty_of(trace_paths(executor, scene, camera, path_settings(16, 16, samples, 2)),
                     channel);
}

Estimate by_one_ray(Executor& executor, const SeenByRay& seen, std::uint32_t samples) {
    return by_one_ray(executor, seen.scene, seen.camera, samples);
}

SelftestCase glass_slabs() {
    const std::string chance = "sides of boundaries are chosen by chance, by what they get";
    const double a = 0.5;
    const double f = fresnel_reflectance(1.0, 1.5, 1.0);
    const WaterInGlass water = water_in_glass(0.1);
    const WaterInGlass gaps = water_in_glass(-0.1);
    return {38,
            "slabs of glass, all reflections inside",
            RunsOn::devices,
            {{"cosine 1", stack_transmittance({{1.5}}), by_chance(0.003, 2e-5), chance},
             {"cosine 0.866", stack_transmittance({{1.5}}, std::sqrt(0.75)), by_chance(0.003, 2e-5),
              chance},
             {"cosine 0.5", stack_transmittance({{1.5}}, 0.5), by_chance(0.003, 2e-5), chance},
             {"half absorbed", a * (1.0 - f) * (1.0 - f) / (1.0 - a * a * f * f),
              by_chance(0.003, 2e-5), chance},
             {"water overlapping two of glass", water.radiance.x, by_chance(0.005, 2e-5), chance},
             {"water between two of glass", gaps.radiance.x, by_chance(0.005, 2e-5), chance}},
            [](Executor& executor) -> std::vector<Measured> {
                const auto clear = [&](double cosine) {
                    return by_one_ray(executor, slab_before_a_wall(glass(1.5)),
                                      oblique_camera(cosine), 128);
                };
                const auto half = absorbing_glass(1.5F, glm::vec3(0.5F), 0.2);
                return {clear(1.0),
                        clear(std::sqrt(0.75)),
                        clear(0.5),
                        by_one_ray(executor, slab_before_a_wall(half), oblique_camera(1.0), 64),
                        by_one_ray(executor, water_in_glass(0.1).scene, oblique_camera(1.0), 64),
                        by_one_ray(executor, water_in_glass(-0.1).scene, oblique_camera(1.0), 64)};
            }};
}

SelftestCase bent_light() {
    const std::string chance = "sides of boundaries are chosen by chance, by what they get";
    return {39,
            "prisms, balls and lamps of glass",
            RunsOn::devices,
            {{"target behind a prism, by Snell's law", target_behind_a_prism().radiance,
              by_chance(0.01, 1e-4), chance},
             {"wall by total reflection", wall_by_total_reflection().radiance,
              by_chance(0.01, 1e-4), chance},
             {"target at the focus of a ball", target_at_a_focus(1.5).radiance,
              by_chance(0.01, 2e-3), "light that is reflected twice inside may meet it, 0.16 %"},
             {"lamp in a block, over the squared index", lamp_in_glass(1.5).radiance,
              by_chance(0.01, 2e-5), chance}},
            [](Executor& executor) -> std::vector<Measured> {
                return {by_one_ray(executor, target_behind_a_prism(), 32),
                        by_one_ray(executor, wall_by_total_reflection(), 32),
                        by_one_ray(executor, target_at_a_focus(1.5), 32),
                        by_one_ray(executor, lamp_in_glass(1.5), 32)};
            }};
}

// Of six sheets that are each there to 30 %.
constexpr float sheet_alpha = 0.3F;
constexpr int sheets = 6;

void add_sheets(SceneBuilder& builder) {
    for (int i = 0; i < sheets; ++i)
        builder.add(
            quad_mesh({-40, -40, 0.5F + 0.05F * static_cast<float>(i)}, {80, 0, 0}, {0, 80, 0}),
            add_surface(builder, sheet(sheet_alpha)));
}

SelftestCase transparent_sheets() {
    const double passes = std::pow(1.0 - double(sheet_alpha), sheets);
    return {40,
            "six sheets of alpha 0.3",
            RunsOn::devices,
            {{"a wall behind them", passes, by_chance(0.02, 1e-5),
              "paths are stopped by sheets by chance"},
             {"irradiance by a sun above them", passes, share(1e-5),
              "shadow rays look through sheets without chance"}},
            [](Executor& executor) -> std::vector<Measured> {
                SceneBuilder wall = bright_wall();
                add_sheets(wall);
                SceneBuilder sun = floor_scene();
                sun.light(LightType::directional, {}, glm::vec3(1.0F));
                add_sheets(sun);
                const Rendering floor = trace_paths(executor, sun.scene, camera_on({0.0, 0.0, 0.0}),
                                                    path_settings(1, 1, 4));
                return {by_one_ray(executor, wall.scene, oblique_camera(1.0), 128),
                        floor.irradiance("direct", 0, 0)};
            }};
}

SelftestCase mirrors() {
    return {41,
            "box of mirrors, and the unfolded scene",
            RunsOn::devices,
            {{"pixels unlike, of 1600", 0.0, within(16.0),
              "roulette ends one path of 1000 at a mirror; at edges rounding decides"},
             {"light of one over the other", 1.0, share(0.01),
              "roulette ends one path of 1000 at a mirror"}},
            [](Executor& executor) -> std::vector<Measured> {
                PathSettings settings = path_settings(40, 40, 1, 3);
                settings.through_centres = true;
                settings.most_bounces = most_mirrors;
                const auto values = [&](const Scene& scene) {
                    return channel_of(
                        trace_paths(executor, scene, camera_among_mirrors(), settings), "", 0);
                };
                const std::vector<double> mirrored = values(box_of_mirrors());
                const std::vector<double> unfolded = values(unfolded_box_of_mirrors());
                double unlike = 0.0;
                double sums[2] = {0.0, 0.0};
                for (std::size_t i = 0; i < mirrored.size(); ++i) {
                    unlike += std::abs(mirrored[i] - unfolded[i]) > 0.005 * unfolded[i] ? 1.0 : 0.0;
                    sums[0] += mirrored[i];
                    sums[1] += unfolded[i];
                }
                return {unlike, sums[0] / sums[1]};
            }};
}

}  // namespace

std::vector<SelftestCase> surface_cases() {
    return {fresnel_means(), white_materials(),    glass_slabs(),
            bent_light(),    transparent_sheets(), mirrors()};
}

}  // namespace weft::selftest
