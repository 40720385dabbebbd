// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_SCALING_SCALING_FRAMES_H
#define WEFT_BENCH_SCALING_SCALING_FRAMES_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/adaptive/adaptive_frames.h"
#include "bench/scaling/scaling_axes.h"
#include "device/executor.h"
#include "tradeoff/image_errors.h"

namespace weft::bench {

/// How the points of an axis are measured, and what their images are compared with.
struct ScalingRun {
    std::vector<FrameMethod>
        methods;  ///< the points' own sampling settings take the place of theirs
    std::uint32_t repetitions = 9;
    std::uint32_t warm_up = 1;
    std::filesystem::path references;    ///< folder
    std::uint32_t reference_spp = 1024;  ///< 0: no errors
    std::uint64_t memory_bytes = 0;      ///< points that take more are left out; 0: none is
    std::function<void(const std::string&)> say;  ///< is told what takes long, without line ends
};

/// The frames of one method at one point.
struct MethodAtPoint {
    std::vector<double> wall_ms;  ///< repetition by repetition
    std::vector<double> device_ms;
    std::uint64_t rays = 0;
    ImageErrors errors{};  ///< of frame 0; empty where the axis has none
};

/// Everything measured at one point.
struct PointFrames {
    double x = 0.0;
    std::uint64_t triangles = 0;
    std::vector<double> build_ms;  ///< of the acceleration structure; where the axis times it
    std::vector<MethodAtPoint> methods;
    nlohmann::json reference{};  ///< of the errors, and the `floor` between its halves; else null
};

/// Everything measured along an axis.
struct AxisFrames {
    std::vector<PointFrames> points;
    std::vector<std::string> left_out;  ///< points, and why
};

/// Frame 0 of every method at every point, again and again: all points and methods take turns,
/// frame by frame. The first `warm_up` rounds do not count. Points render on `executor`, those with
/// a number of threads on native kernels of their own; references on `path_executor`. Throws Error.
[[nodiscard]] AxisFrames measure_axis(const ScalingAxis& axis, const ScalingRun& run,
                                      Executor& executor, Executor& path_executor);

/// Host memory that is free for use, bytes: what the system says is available, or what is left of
/// the control group's limit where that is less. 0 where it is not known.
[[nodiscard]] std::uint64_t available_memory();

}  // namespace weft::bench

#endif
