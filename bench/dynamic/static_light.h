// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_STATIC_LIGHT_H
#define WEFT_BENCH_DYNAMIC_STATIC_LIGHT_H

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/dynamic/dynamic_methods.h"
#include "device/executor.h"
#include "image/image.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft::bench {

/// How single frames of a scene that holds still are compared.
struct StaticRun {
    std::uint32_t edge = 512;  ///< of the image, pixels
    std::uint32_t repetitions = 5;
    std::uint32_t converged = 8;  ///< frames of `ir` that make a converged one
};

/// What the indirect light of single frames is compared with; images of the layer `indirect`.
struct StaticReferences {
    Image path;  ///< path-traced through pixel centres: all the light there is
    Image ir;    ///< many VPLs at every pixel: what a method would be without its own errors
};

/// An image by `ir`, the mean of `count` frames with VPLs of their own.
[[nodiscard]] Image many_vpls(Executor& executor, const FlatScene& flat, const Camera& camera,
                              std::uint32_t edge, std::uint32_t count);

/// Frames of those methods whose light is indirect alone and of one frame, which take turns: every
/// repetition has random numbers of its own. A list of rows: times are medians, errors and rays
/// means over the repetitions.
[[nodiscard]] nlohmann::json measure_static(Executor& executor, const FlatScene& flat,
                                            const Camera& camera,
                                            const std::vector<DynamicMethod>& methods,
                                            const StaticReferences& references,
                                            const StaticRun& run);

[[nodiscard]] std::string static_heading();
/// A scene as a table.
[[nodiscard]] std::string static_table(const nlohmann::json& scene);
/// Means over scenes; null for what has no value.
[[nodiscard]] nlohmann::json static_summary(const nlohmann::json& scenes);

}  // namespace weft::bench

#endif
