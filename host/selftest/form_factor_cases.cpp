// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "selftest/case_groups.h"
#include "selftest/closed_forms.h"
#include "selftest/measurements.h"
#include "selftest/path_rendering.h"
#include "selftest/scene_builder.h"

// Form factors of unit squares: a square of radiance 1 lights another one, of albedo 1, that fills
// the image, so that the mean of the image is the form factor.
namespace weft::selftest {
namespace {

constexpr std::uint32_t pixels = 16;

Camera above() {
    return look_at({0.5, 0.5, 0.5}, {0.5, 0.5, 0.0}, std::numbers::pi / 2.0);
}

FlatScene squares(const Mesh& area_light) {
    SceneBuilder builder;
    builder.add(quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), builder.material(glm::vec3(1.0F)));
    builder.add(area_light, builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    return flatten(builder.scene);
}

FlatScene parallel_squares() {
    return squares(quad_mesh({0, 0, 1}, {0, 1, 0}, {1, 0, 0}));
}

FlatScene perpendicular_squares() {
    return squares(quad_mesh({0, 0, 0}, {0, 1, 0}, {0, 0, 1}));
}

/// The same area light in more triangles than an area light may have to be computed in closed form
/// nearby (analytic_area_light_limit.h), so that the bound on samples applies.
FlatScene perpendicular_squares_in_pieces() {
    return squares(quad_mesh({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 3));
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

constexpr std::uint32_t bounded_pixels = 48;
constexpr double bound = 6.0;  // on the geometry term, divided by the area light's area

/// The perpendicular squares' form factor with a bound on the geometry term, which is infinite at
/// their common edge: a mean over the centres of pixels and, by the midpoint rule, over the area
/// light, whose height is the square of a variable. With 128 steps instead of 64 it is 1e-5 less.
double bounded_form_factor() {
    constexpr int steps = 64;
    constexpr auto rows = static_cast<int>(bounded_pixels);
    double sum = 0.0;
    for (int column = 0; column < rows; ++column)
        for (int row = 0; row < rows / 2; ++row) {  // the other half is its mirror image
            const double x = (column + 0.5) / rows;
            const double y = (row + 0.5) / rows;
            for (int k = 0; k < steps; ++k) {
                const double root = (k + 0.5) / steps;
                const double z = root * root;
                for (int i = 0; i < steps; ++i) {
                    const double dy = (i + 0.5) / steps - y;
                    const double square = x * x + dy * dy + z * z;
                    sum += 2.0 * root * std::min(x * z / (square * square), bound);
                }
            }
        }
    return sum / (0.5 * rows * rows * steps * steps * std::numbers::pi);
}

/// The form factor by light samples with that bound on their geometry terms, with or without the
/// residual.
Estimate under_bound(Executor& executor, const FlatScene& flat, bool compensation) {
    return over_seeds([&](std::uint32_t seed) {
        RenderSettings settings = small_settings(Algorithm::ir, bounded_pixels, bounded_pixels);
        settings.sampling.samples_per_light = 32;
        // The bound is pi n / c^2 of n samples in all sets.
        settings.sampling.bound_spacing = std::sqrt(std::numbers::pi * 9.0 * 32.0 / bound);
        settings.sampling.compensation = compensation;
        settings.indirect = false;
        settings.seed = seed;
        const Rendering rendering = render_flat(executor, flat, above(), settings);
        return mean_irradiance(rendering, "direct") / std::numbers::pi;
    });
}

std::string grid_reason() {
    return "samples differ by seed; the grid of pixel centres is off by less than 1e-3";
}

std::string path_reason() {
    return "paths are random and lie all over the square; 1e-5 is for sums of floats";
}

}  // namespace

std::vector<SelftestCase> form_factor_cases() {
    const Tolerance of_grid = by_chance(0.01, 1e-3, image_seeds);
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
           "the sum of two estimates by paths"},
          {"light samples and the closed form nearby", perpendicular_form_factor,
           by_chance(5e-3, 2e-4, image_seeds),
           "samples differ by seed; the grid of pixel centres is off by 1e-4 of it"},
          {"light samples under a bound of 6", bounded_form_factor(),
           by_chance(5e-3, 5e-5, image_seeds),
           "samples differ by seed; the sum that is expected is off by 2e-5 of it"},
          {"the same with the residual", perpendicular_form_factor,
           by_chance(0.01, 2e-4, image_seeds),
           "one path a pixel brings what is left out; the grid is off by 1e-4 of it"}},
         [](Executor& executor) -> std::vector<Measured> {
             const FlatScene flat = perpendicular_squares();
             const FlatScene pieces = perpendicular_squares_in_pieces();
             const Estimate beside = by_paths(executor, flat);
             const Estimate across = by_paths(executor, parallel_squares());
             const Estimate closure{across.mean + 4.0 * beside.mean,
                                    std::hypot(across.error, 4.0 * beside.error)};
             return {by_light_samples(executor, flat),
                     beside,
                     closure,
                     under_bound(executor, flat, false),
                     under_bound(executor, pieces, false),
                     under_bound(executor, pieces, true)};
         }}};
}

}  // namespace weft::selftest
