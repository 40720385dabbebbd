// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_STATS_JSON_H
#define WEFT_APP_STATS_JSON_H

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/options.h"
#include "device/executor.h"
#include "frame/frame_renderer.h"
#include "frame/renderer.h"

namespace weft {

/// Milliseconds of the parts of a run.
struct RunTimes {
    double read_scene_ms = 0.0;
    double open_device_ms = 0.0;
    double build_kernels_ms = 0.0;  ///< of all programs together, some compiled at the same time
    double build_bvh_ms = 0.0;
    double render_ms = 0.0;
    double write_ms = 0.0;
    double total_ms = 0.0;  ///< from the start of the program to the written picture
};

/// Values of one component that were negative or not finite, over all frames.
struct NonfiniteSummary {
    std::string component;
    std::uint64_t count = 0;          ///< above 0
    std::uint32_t first_picture = 0;  ///< the first with such a value, from 0 on
    std::uint32_t first_sample = 0;   ///< its first frame with such a value
    std::uint32_t first_pixel = 0;    ///< its first such pixel, row-major
};

/// The components that had such values.
[[nodiscard]] std::vector<NonfiniteSummary> nonfinite_of(const FrameRenderer& renderer);

[[nodiscard]] nlohmann::json device_json(const DeviceInfo& device);

/// The content of `--stats`; `options` as they took effect.
[[nodiscard]] nlohmann::json stats_json(const RenderOptions& options, const Executor& executor,
                                        const FrameRenderer& renderer, const FlatScene& scene,
                                        const RenderSettings& settings, const RunTimes& times);

}  // namespace weft

#endif
