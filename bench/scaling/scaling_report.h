// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_SCALING_SCALING_REPORT_H
#define WEFT_BENCH_SCALING_SCALING_REPORT_H

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/scaling/scaling_frames.h"

namespace weft::bench {

/// Medians at every point of an axis, and the laws fitted to them: of frames by method, of builds,
/// and how errors fall or rise as a power of x.
[[nodiscard]] nlohmann::json axis_json(const ScalingAxis& axis,
                                       const std::vector<FrameMethod>& methods,
                                       const AxisFrames& frames);

/// The table of one axis, of what axis_json makes.
[[nodiscard]] std::string axis_table(const nlohmann::json& axis);

/// By axis: exponents and parameters of the laws.
[[nodiscard]] nlohmann::json scaling_summary(const nlohmann::json& axes);

}  // namespace weft::bench

#endif
