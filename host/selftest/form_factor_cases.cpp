// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "selftest/case_groups.h"
#include "selftest/closed_forms.h"
#include "selftest/measurements.h"
#include "selftest/path_rendering.h"
#include "selftest/scene_builder.h"

// Form factors of unit squares: a square of radiance 1 lights another one, of albedo 1, that fills
// the picture, so that the mean of the picture is the form factor.
namespace weft::selftest {
namespace {

constexpr std::uint32_t pixels = 16;

Camera above() {
    return look_at({0.5, 0.5, 0.5}, {0.5, 0.5, 0.0}, std::numbers::pi / 2.0);
}

FlatScene squares(const Mesh& lamp) {
    SceneBuilder builder;
    builder.add(quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), builder.material(glm::vec3(1.0F)));
    builder.add(lamp, builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    return flatten(builder.scene);
}

FlatScene parallel_squares() {
    return squares(quad_mesh({0, 0, 1}, {0, 1, 0}, {1, 0, 0}));
}

FlatScene perpendicular_squares() {
    return squares(quad_mesh({0, 0, 0}, {0, 1, 0}, {0, 0, 1}));
}

Estimate by_light_samples(Executor& executor, const FlatScene& flat) {
    return over_seeds([&](std::uint32_t seed) {
        RenderSettings settings = unbounded(small_settings(Algorithm::ir, pixels, pixels));
        settings.sampling.samples_per_light = 128;
        settings.sampling.max_samples_per_set = 128;
        settings.indirect = false;
        settings.seed = seed;
        const Rendering rendering = render_flat(executor, flat, above(), settings);
        return mean_irradiance(rendering, "direct") / std::numbers::pi;
    });
}

Estimate by_paths(Executor& executor, const FlatScene& flat) {
    return beauty_of(trace_flat(executor, flat, above(), path_settings(24, 24, 64)), 0);
}

std::string grid_reason() {
    return "samples differ by seed; the grid of pixel centres is off by less than 1e-3";
}

std::string path_reason() {
    return "paths are random and lie all over the square; 1e-5 is for sums of floats";
}

}  // namespace

std::vector<SelftestCase> form_factor_cases() {
    const Tolerance of_grid = by_chance(0.01, 1e-3, picture_seeds);
    return {
        {4,
         "parallel unit squares",
         RunsOn::devices,
         {{"form factor by light samples", parallel_form_factor, of_grid, grid_reason()},
          {"form factor by paths", parallel_form_factor, by_chance(0.02, 1e-5), path_reason()}},
         [](Executor& executor) -> std::vector<Measured> {
             const FlatScene flat = parallel_squares();
             return {by_light_samples(executor, flat), by_paths(executor, flat)};
         }},
        {5,
         "perpendicular unit squares",
         RunsOn::devices,
         {{"form factor by light samples", perpendicular_form_factor, of_grid, grid_reason()},
          {"form factor by paths", perpendicular_form_factor, by_chance(0.02, 1e-5), path_reason()},
          {"five sides of a cube together", 1.0, by_chance(0.02, 1e-5),
           "the sum of two estimates by paths"}},
         [](Executor& executor) -> std::vector<Measured> {
             const FlatScene flat = perpendicular_squares();
             const Estimate beside = by_paths(executor, flat);
             const Estimate across = by_paths(executor, parallel_squares());
             const Estimate closure{across.mean + 4.0 * beside.mean,
                                    std::hypot(across.error, 4.0 * beside.error)};
             return {by_light_samples(executor, flat), beside, closure};
         }}};
}

}  // namespace weft::selftest
