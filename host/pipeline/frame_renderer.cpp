// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/frame_renderer.h"

namespace weft {

FrameStats frame_stats(FrameContext& frame, const Stopwatch& watch) {
    FrameStats stats;
    const auto& stages = frame.stages();
    stats.ms = watch.total();
    stats.stages.assign(stages.begin(), stages.end());
    for (const StageStats& stage : stats.stages) stats.rays += stage.rays;
    const auto counters = read_buffer(frame.executor, frame.buffers.nonfinite, 1).front();
    for (std::size_t c = 0; c < stats.nonfinite.size(); ++c)
        stats.nonfinite[c] = {counters.count[c], counters.first_pixel[c]};
    clear_nonfinite(frame.executor, frame.buffers.nonfinite);
    return stats;
}

}  // namespace weft
