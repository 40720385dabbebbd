// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_PATH_ALGORITHMS_H
#define WEFT_BENCH_PATH_PATH_ALGORITHMS_H

#include <memory>
#include <span>
#include <string_view>

#include "device/executor.h"
#include "pipeline/frame_renderer.h"
#include "render/reference_renderer.h"

namespace weft::bench {

/// An algorithm of the path family: unbiased, and given so many samples of every pixel.
struct PathAlgorithm {
    std::string_view name;  ///< as `weft render --algorithm` has it
    /// A renderer of the image that the settings describe, its seed included. What it is given must
    /// outlive it.
    std::unique_ptr<FrameRenderer> (*make)(Executor& executor, const FlatScene& scene,
                                           const Camera& camera, const PathSettings& settings);
};

/// All that can be measured.
[[nodiscard]] std::span<const PathAlgorithm> path_algorithms();

/// The one of that name; throws Error (exit code 1) where there is none.
[[nodiscard]] const PathAlgorithm& path_algorithm(std::string_view name);

}  // namespace weft::bench

#endif
