// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "selftest/case_groups.h"
#include "selftest/closed_forms.h"
#include "selftest/floor_light.h"

// Area lights over a floor, by light samples and by path tracing.
namespace weft::selftest {
namespace {

const glm::dvec3 origin(0.0, 0.0, 0.0);
const glm::dvec3 beside(1.0, 0.0, 0.0);

std::string by_samples() {
    return "samples differ by seed, and their own scatter says how well they are known";
}

std::string by_paths() {
    return "paths are random, and pixels are independent";
}

SceneBuilder under_square() {
    SceneBuilder builder = floor_scene();
    builder.add(area_light_mesh(), builder.material(glm::vec3(0.5F), radiance));
    return builder;
}

SelftestCase square_light() {
    constexpr double below = 0.7522746885;
    constexpr double off_axis = 0.2650048523;
    return {6,
            "square light (Lambert's formula)",
            RunsOn::devices,
            {{"below its centre, light samples", below, sampled_tolerance(), by_samples()},
             {"beside it, light samples", off_axis, sampled_tolerance(), by_samples()},
             {"below its centre, paths", below, traced_tolerance(), by_paths()},
             {"beside it, paths", off_axis, traced_tolerance(), by_paths()}},
            [](Executor& executor) -> std::vector<Measured> {
                const FlatScene flat = flatten(under_square().scene);
                return {sampled_irradiance(executor, flat, origin),
                        sampled_irradiance(executor, flat, beside),
                        traced_irradiance(executor, flat, origin),
                        traced_irradiance(executor, flat, beside)};
            }};
}

/// Irradiance at (x, 0, 0) of the square light behind a half plane at height 1/2 over x > 0.1,
/// which hides what lies beyond 0.2 - x.
double clipped_irradiance(double x) {
    const double end = std::min(0.5, 0.2 - x);
    return polygon_irradiance(
        {{-0.5, -0.5, 1.0}, {-0.5, 0.5, 1.0}, {end, 0.5, 1.0}, {end, -0.5, 1.0}}, {x, 0.0, 0.0},
        {0.0, 0.0, 1.0});
}

SelftestCase clipped_light() {
    return {
        7,
        "square light behind a half plane",
        RunsOn::devices,
        {{"in half shadow, light samples", clipped_irradiance(0.0), sampled_tolerance(),
          by_samples()},
         {"deep in half shadow, paths", clipped_irradiance(0.4), traced_tolerance(), by_paths()},
         {"outside of the shadow, light samples", clipped_irradiance(-1.0), sampled_tolerance(),
          by_samples()},
         {"in full shadow, light samples", 0.0, within(0.0), "every ray is blocked"}},
        [](Executor& executor) -> std::vector<Measured> {
            SceneBuilder builder = under_square();
            builder.add(quad_mesh({0.1F, -5.0F, 0.5F}, {5.0F, 0.0F, 0.0F}, {0.0F, 10.0F, 0.0F}),
                        builder.material(glm::vec3(0.0F)));
            const FlatScene flat = flatten(builder.scene);
            return {sampled_irradiance(executor, flat, origin),
                    traced_irradiance(executor, flat, {0.4, 0.0, 0.0}),
                    sampled_irradiance(executor, flat, {-1.0, 0.0, 0.0}),
                    exact_irradiance(executor, flat, {2.0, 0.0, 0.0})};
        }};
}

/// The case of a light over the floor whose mesh approximates a round shape.
SelftestCase round_light(int number, const std::string& name, LitFloor (*make)(),
                         const std::string& mesh) {
    const LitFloor lit = make();
    return {number,
            name,
            RunsOn::devices,
            {{"light samples", lit.irradiance.x, sampled_tolerance(lit.bias),
              mesh + "; samples differ by seed"},
             {"paths", lit.irradiance.x, traced_tolerance(lit.bias), mesh + "; paths are random"}},
            [make](Executor& executor) -> std::vector<Measured> {
                const FlatScene flat = flatten(make().scene);
                return {sampled_irradiance(executor, flat, origin),
                        traced_irradiance(executor, flat, origin)};
            }};
}

}  // namespace

std::vector<SelftestCase> area_light_cases() {
    return {square_light(), clipped_light(),
            round_light(8, "sphere light above the horizon", sphere_over_floor,
                        "the outline of 5120 triangles lacks up to 2e-3 of the sphere's"),
            round_light(9, "disk light on its axis", disk_over_floor,
                        "128 chords leave out 4e-4 of the disk")};
}

}  // namespace weft::selftest
