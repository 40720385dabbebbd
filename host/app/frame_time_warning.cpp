// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/frame_time_warning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft {
namespace {

constexpr std::size_t most_frames = 8;
// Gains change by no more than 1.25 a frame, so that times near the target swing about it.
constexpr double clearly_longer = 1.25;

/// Whether a longer run would have come closer to the target.
bool can_be_faster(const FrameStats& frame) {
    return std::any_of(frame.levels.begin(), frame.levels.end(),
                       [](const LevelStats& level) { return level.can_save; });
}

}  // namespace

std::optional<std::string> frame_time_warning(double target_ms,
                                              std::span<const FrameStats> frames) {
    const auto last = frames.last(std::min(frames.size(), most_frames));
    if (last.empty()) return {};
    std::vector<double> times;
    for (const FrameStats& frame : last) times.push_back(frame.ms);
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    if (!(*middle > clearly_longer * target_ms)) return {};
    if (can_be_faster(last.back()))
        return fmt::format(
            "--frame-time: {:.3g} ms were not reached, a sample took {:.3g} ms in the end; a "
            "longer run comes closer",
            target_ms, *middle);
    return fmt::format(
        "--frame-time: {:.3g} ms cannot be reached, a sample takes {:.3g} ms with as little light "
        "sampled as thresholds allow",
        target_ms, *middle);
}

}  // namespace weft
