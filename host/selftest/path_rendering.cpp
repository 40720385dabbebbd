// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/path_rendering.h"

#include <cmath>
#include <vector>

#include "scene/validate_scene.h"

namespace weft::selftest {

PathSettings path_settings(std::uint32_t width, std::uint32_t height, std::uint32_t samples,
                           std::uint32_t seed) {
    PathSettings settings;
    settings.width = width;
    settings.height = height;
    settings.samples = {0, samples};
    settings.seed = seed;
    return settings;
}

Rendering trace_flat(Executor& executor, const FlatScene& flat, const Camera& camera,
                     const PathSettings& settings) {
    PathRenderer renderer(executor, flat, camera, settings, {});
    while (renderer.render_frame({})) continue;
    return {renderer.image(), renderer.stats(), renderer.plan()};
}

Rendering trace_paths(Executor& executor, const Scene& scene, const Camera& camera,
                      const PathSettings& settings) {
    validate_scene(scene);
    return trace_flat(executor, flatten(scene), camera, settings);
}

Estimate beauty_of(const Rendering& rendering, std::uint32_t channel) {
    Estimate result;
    const std::vector<double> values = channel_of(rendering, "", channel);
    for (const double value : values) result.mean += value;
    for (const double variance : channel_of(rendering, "variance", channel))
        result.error += variance;
    const auto n = static_cast<double>(values.size());
    return {result.mean / n, std::sqrt(result.error) / n};
}

Estimate layer_of(const Rendering& rendering, std::string_view layer, std::uint32_t channel) {
    return estimate(channel_of(rendering, layer, channel));
}

}  // namespace weft::selftest
