// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/light_exponent.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// Largest exponent of light: 2 to its power and its square must stay normal floats.
constexpr double largest_exponent = 60.0;

// Square of the ratio of the scene's radius to the distance at which a surface may be from a point
// light.
constexpr double nearness = 0x1p20;

/// Radiance of the brightest light or medium; for lights without area, that of a surface close to
/// them.
double brightest(const FlatScene& scene) {
    const auto radius = static_cast<double>(scene.radius);
    double most = scene.media.radiance;
    for (const shared::LightRecord& light : scene.lights) {
        double value = std::max({light.power.x, light.power.y, light.power.z});
        if (light.kind == EMITTER_POINT || light.kind == EMITTER_SPOT)
            value *= nearness / (radius * radius);
        if (light.kind == EMITTER_ENVIRONMENT && scene.environment_image.present())
            value *= static_cast<double>(scene.environment_image.brightest);
        most = std::max(most, value);
    }
    return most;
}

}  // namespace

int light_exponent(const FlatScene& scene) {
    const double most = brightest(scene);
    if (!(most > 0.0) || !std::isfinite(most)) return 0;
    return static_cast<int>(
        std::clamp(std::ceil(std::log2(most)), -largest_exponent, largest_exponent));
}

}  // namespace weft
