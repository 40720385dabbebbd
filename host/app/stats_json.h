// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_STATS_JSON_H
#define WEFT_APP_STATS_JSON_H

#include <nlohmann/json.hpp>

#include "app/options.h"
#include "device/executor.h"
#include "render/renderer.h"
#include "session/render_session.h"

namespace weft {

/// Times of the parts of a run.
struct RunTimes {
    double read_scene_ms = 0.0;
    double open_device_ms = 0.0;
    double build_kernels_ms = 0.0;  ///< of all programs together, some compiled at the same time
    double build_bvh_ms = 0.0;
    double render_ms = 0.0;
    double denoise_ms = 0.0;
    double correct_ms = 0.0;  ///< a part of render_ms: correcting previews by unbiased samples
    double write_ms = 0.0;
    double total_ms = 0.0;  ///< from the start of the program to the written image
};

[[nodiscard]] nlohmann::json device_json(const DeviceInfo& device);

/// The content of `--stats`; `options` as they took effect, `settings` those of a preview with the
/// same options.
[[nodiscard]] nlohmann::json stats_json(const RenderOptions& options, const RenderSession& session,
                                        const RenderSettings& settings, const RunTimes& times);

}  // namespace weft

#endif
