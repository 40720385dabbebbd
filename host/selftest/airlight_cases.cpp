// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "selftest/case_groups.h"
#include "selftest/closed_forms.h"
#include "selftest/measurements.h"
#include "selftest/media_builder.h"
#include "selftest/path_rendering.h"

// A point light in an infinite medium that scatters isotropically.
namespace weft::selftest {
namespace {

SceneBuilder foggy_space(const glm::dvec3& light) {
    SceneBuilder builder;
    builder.scene.media.push_back(medium_of(glm::vec3(0.3F), glm::vec3(1.0F)));
    builder.scene.outer_medium = 0;
    builder.light(LightType::point, light, glm::vec3(2.0F));
    return builder;
}

std::vector<Measured> measure_airlight(Executor& executor) {
    constexpr double gamma = 0.9;
    SceneBuilder builder = foggy_space({1.5 * std::sin(gamma), 0.0, -1.5 * std::cos(gamma)});
    builder.add(quad_mesh({-0.1F, -0.1F, -4.0F}, {0.2F, 0.0F, 0.0F}, {0.0F, 0.2F, 0.0F}),
                builder.material(glm::vec3(0.0F)));
    const FlatScene flat = flatten(builder.scene);
    const Camera camera = look_at({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 1e-4);
    PathSettings paths = path_settings(24, 24, 64);
    paths.indirect = false;
    RenderSettings preview = unbounded(small_settings(Algorithm::igi, 6, 6));
    preview.indirect = false;
    preview.sampling.bounces = 0;
    return {layer_of(trace_flat(executor, flat, camera, paths), "direct", 0),
            farthest_from(sun_airlight, channel_of(render_flat(executor, flat, camera, preview, 32),
                                                   "media", 0))};
}

/// Number of values that are not finite, negative or guarded; 1 for an image without any light.
double bad_fog(Executor& executor, double angle) {
    const SceneBuilder builder = foggy_space({0.0, 0.0, -1.0});
    const Rendering rendering =
        render(executor, builder.scene, look_at({0.0, 0.0, 0.0}, {0.0, 0.0, -2.0}, angle),
               unbounded(small_settings(Algorithm::igi, 9, 9)));
    return bad_values(rendering) + (mean_of(rendering.layer("media")) > 0.0 ? 0.0 : 1.0);
}

}  // namespace

std::vector<SelftestCase> airlight_cases() {
    const std::string bounded = "the integral has no bound, but every estimate of it has";
    return {{13,
             "airlight of a point light",
             RunsOn::devices,
             {{"paths", sun_airlight, by_chance(0.01, 1e-5),
               "paths are random, and pixels are independent"},
              {"igi, worst pixel", sun_airlight, share(1e-3),
               "4608 places lie evenly on the ray: 32 frames of 16 for each of 9 sets"}},
             measure_airlight},
            {14,
             "a light on the ray through a medium",
             RunsOn::devices,
             {{"bad values, the light in every pixel", 0.0, within(0.0), bounded},
              {"bad values, the light in one pixel", 0.0, within(0.0), bounded},
              {"bad values of paths", 0.0, within(0.0), bounded}},
             [](Executor& executor) -> std::vector<Measured> {
                 return {bad_fog(executor, 1e-4), bad_fog(executor, 1.0),
                         bad_values(trace_paths(executor, foggy_space({0.0, 0.0, -1.0}).scene,
                                                look_at({0.0, 0.0, 0.0}, {0.0, 0.0, -2.0}, 1e-4),
                                                path_settings(9, 9, 8)))};
             }}};
}

}  // namespace weft::selftest
