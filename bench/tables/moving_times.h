// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_TABLES_MOVING_TIMES_H
#define WEFT_BENCH_TABLES_MOVING_TIMES_H

#include <cstdint>
#include <vector>

#include "base/diagnostics.h"
#include "bench/common/bench_scenes.h"
#include "device/executor.h"
#include "plan/frame_plan.h"

namespace weft::bench {

/// What full frames of a sequence took, milliseconds, frame by frame from the second on.
struct MovingTimes {
    std::vector<double> ic;      ///< records are made anew
    std::vector<double> tic;     ///< records are kept
    std::vector<double> update;  ///< before each, of bringing the scene on the device up to date
};

/// Frames of `edge` x `edge` pixels of the scene with a small box that slides across the middle of
/// the image, the sequence `box` of bench dynamic: by `ic` and `tic`, which take turns. `frames`:
/// at least 3. For scenes without media.
[[nodiscard]] MovingTimes measure_moving(const BenchScene& source, const SamplingSettings& sampling,
                                         std::uint32_t edge, std::uint32_t frames,
                                         Executor& executor, Diagnostics& diagnostics);

}  // namespace weft::bench

#endif
