// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/floor_light.h"

#include <numbers>

namespace weft::selftest {
namespace {

RenderSettings one_pixel(std::uint32_t seed) {
    RenderSettings settings = unbounded(small_settings(Algorithm::ir, 1, 1));
    settings.sampling.samples_per_light = 1024;
    settings.sampling.max_samples_per_set = 4096;
    settings.indirect = false;
    settings.seed = seed;
    return settings;
}

double one_irradiance(Executor& executor, const FlatScene& flat, const glm::dvec3& point,
                      std::uint32_t seed) {
    return render_flat(executor, flat, camera_on(point), one_pixel(seed))
        .irradiance("direct", 0, 0);
}

}  // namespace

Camera camera_on(const glm::dvec3& point) {
    return look_at(point + eye_offset, point, 0.001);
}

Estimate sampled_irradiance(Executor& executor, const FlatScene& flat, const glm::dvec3& point) {
    return over_seeds(
        [&](std::uint32_t seed) { return one_irradiance(executor, flat, point, seed); });
}

double exact_irradiance(Executor& executor, const FlatScene& flat, const glm::dvec3& point) {
    return one_irradiance(executor, flat, point, 0);
}

Estimate traced_irradiance(Executor& executor, const FlatScene& flat, const glm::dvec3& point) {
    const Rendering rendering =
        trace_flat(executor, flat, camera_on(point), path_settings(20, 20, 64));
    return scaled(layer_of(rendering, "direct", 0),
                  std::numbers::pi / static_cast<double>(receiver_albedo.x));
}

Tolerance sampled_tolerance(double bias) {
    return by_chance(3e-3, bias + 2e-6, image_seeds);
}

Tolerance traced_tolerance(double bias) {
    return by_chance(0.03, bias + 1e-5);
}

}  // namespace weft::selftest
