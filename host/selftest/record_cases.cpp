// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/scene_builder.h"

// Irradiance records where light changes over short distances.
namespace weft::selftest {
namespace {

/// Settings without roulette, so that records and pixels of `ir` gather the same virtual lights.
RenderSettings settings_of(Algorithm algorithm, std::uint32_t width, std::uint32_t height) {
    RenderSettings settings = small_settings(algorithm, width, height);
    settings.sampling.roulette = 0.0;
    settings.direct = false;
    return settings;
}

/// The room [-1,1]^3 without its front.
SceneBuilder open_box() {
    SceneBuilder builder;
    const std::uint32_t white = builder.material({0.8F, 0.8F, 0.8F});
    builder.add(quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}), white);
    builder.add(quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), white);
    builder.add(quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}), white);
    builder.add(quad_mesh({1, -1, -1}, {0, 0, 2}, {0, 2, 0}), white);
    builder.add(quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), white);
    return builder;
}

Camera in_front() {
    return look_at({0, 0, 3.4}, {0, 0, 0}, 0.75);
}

/// The brightest pixel in the dark half of a box, divided by the mean of the lit half. A wall of
/// 1/1000 of the box's width separates the halves.
double leaked_share(Executor& executor, Algorithm algorithm, std::uint32_t width) {
    const std::uint32_t height = 3 * width / 4;
    SceneBuilder builder = open_box();
    for (const float x : {-0.001F, 0.001F})
        builder.add(quad_mesh({x, -1, -1}, {0, 2, 0}, {0, 0, 2}), 0);
    builder.light(LightType::point, {-0.5, 0.0, 0.3}, glm::vec3(1.0F));
    RenderSettings settings = settings_of(algorithm, width, height);
    settings.sampling.cache_rays = 64;  // of irradiance-cache, where each is a path
    const Rendering cached = render(executor, builder.scene, in_front(), settings);
    double bright = 0.0;
    double leaked = 0.0;
    double pixels = 0.0;
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const auto light = static_cast<double>(cached.at("indirect", x, y));
            // The wall's own front edge is seen in the middle columns.
            if (x < width / 2 - 1) bright += light;
            if (x >= width / 2 + 1) leaked = std::max(leaked, light);
            pixels += x < width / 2 - 1 && light > 0.0 ? 1.0 : 0.0;
        }
    return leaked / (bright / pixels);
}

/// A spot of light on the floor beside the wall, from which most virtual lights shine.
SceneBuilder bright_patch() {
    SceneBuilder builder = open_box();
    PunctualLight& spot =
        builder.light(LightType::spot, {-0.5, 0.8, 0.0}, glm::vec3(4.0F), {-0.22, -1.0, 0.0});
    spot.cos_inner = 0.998F;
    spot.cos_outer = 0.995F;
    return builder;
}

/// The largest error of a pixel, relative to its value or at least to `least` of the mean, with one
/// bounce, so that all light comes from the patch: with more, virtual lights close to a crease
/// would each cast a bright spot smaller than a pixel on the other wall, which has nothing to do
/// with the patch.
double worst_pixel(Executor& executor, const FlatScene& flat, double error, double least) {
    const auto light_of = [&](Algorithm algorithm) {
        RenderSettings settings = settings_of(algorithm, 64, 48);
        settings.sampling.bounces = 1;
        settings.sampling.cache_error = error;
        return render_flat(executor, flat, in_front(), settings).layer("indirect");
    };
    const std::vector<float> expected = light_of(Algorithm::ir);
    const std::vector<float> found = light_of(Algorithm::ic);
    const double dim = least * mean_of(expected);
    if (!(dim > 0.0)) return NAN;  // an image without light would have no error
    std::vector<double> errors;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto light = static_cast<double>(expected[i]);
        errors.push_back((static_cast<double>(found[i]) - light) / std::max(light, dim));
    }
    return std::abs(farthest_from(0.0, errors));
}

std::vector<Measured> measure_patch(Executor& executor) {
    const FlatScene flat = flatten(bright_patch().scene);
    const Rendering all =
        render_flat(executor, flat, in_front(), settings_of(Algorithm::ir, 64, 48));
    const auto cached = [&](double error) {
        RenderSettings settings = settings_of(Algorithm::ic, 64, 48);
        settings.sampling.cache_error = error;
        return render_flat(executor, flat, in_front(), settings);
    };
    const Rendering coarse = cached(0.05);
    return {std::sqrt(relative_mse(all.layer("indirect"), coarse.layer("indirect"))),
            mean_of(coarse.layer("indirect")) / mean_of(all.layer("indirect")),
            std::sqrt(relative_mse(all.layer("indirect"), cached(0.0).layer("indirect"))),
            worst_pixel(executor, flat, 0.02, 0.01), worst_pixel(executor, flat, 0.0, 1.0)};
}

}  // namespace

std::vector<SelftestCase> record_cases() {
    return {{22,
             "a wall of 1/1000 beside light",
             RunsOn::devices,
             {{"ic, leaked light over that beside it", 0.0, within(1e-4),
               "rays ask wherever something may lie between a record and a pixel"},
              {"irradiance-cache, the same", 0.0, within(1e-4),
               "records beside the wall have met it, and serve a tenth of the way to it"}},
             [](Executor& executor) -> std::vector<Measured> {
                 return {leaked_share(executor, Algorithm::ic, 128),
                         leaked_share(executor, Algorithm::irradiance_cache, 64)};
             }},
            {23,
             "a bright patch beside a wall",
             RunsOn::devices,
             {{"ic, relative RMS error at an aim of 5 %", 0.0, within(0.05),
               "the error that is allowed"},
              {"ic, mean over that of ir", 1.0, within(0.05),
               "the mean stays within the error that is allowed"},
              {"ic, relative RMS error at an aim of 0", 0.0, within(1e-4),
               "every pixel is a record, so only roundings differ"},
              {"ic, worst pixel at an aim of 2 %", 0.0, within(0.08),
               "at its rim a record errs by up to four times its mean error, which is what is "
               "aimed at"},
              {"ic, worst pixel at an aim of 0, of the mean", 0.0, within(1e-4),
               "every pixel is a record; roundings may decide on rays along a crease, which carry "
               "little"}},
             measure_patch}};
}

}  // namespace weft::selftest
