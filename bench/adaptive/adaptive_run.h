// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_ADAPTIVE_ADAPTIVE_RUN_H
#define WEFT_BENCH_ADAPTIVE_ADAPTIVE_RUN_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "bench/adaptive/adaptive_frames.h"
#include "bench/adaptive/adaptive_report.h"
#include "bench/common/bench_scenes.h"
#include "device/executor.h"
#include "tradeoff/reference_floor.h"

namespace weft::bench {

/// How scenes are measured, and what their images are compared with.
struct AdaptiveRun {
    std::vector<FrameMethod> methods;
    FrameRun frames;
    std::vector<std::string> filters{"box", "centre"};  ///< of references; none: times alone
    bool layers = true;                ///< errors of direct and indirect light as well
    std::filesystem::path references;  ///< folder
    std::uint32_t reference_spp = 2500;
    /// A reference that is known to have no larger floor will do, whatever its number of samples.
    std::optional<ReferenceFloor> enough{};
    std::filesystem::path images{};               ///< folder to write all of them to; or empty
    std::function<void(const std::string&)> say;  ///< is told what takes long, without line ends
};

/// A scene file to measure.
struct AdaptiveSource {
    BenchScene scene;
    bool shipped = false;  ///< with Weft
};

/// Measures frames of the scene by all methods on `executor`, and compares them with references of
/// two halves, which `path_executor` renders where they are missing. Throws Error.
[[nodiscard]] AdaptiveScene measure_scene(const AdaptiveSource& source, const AdaptiveRun& run,
                                          Executor& executor, Executor& path_executor,
                                          Diagnostics& diagnostics);

}  // namespace weft::bench

#endif
