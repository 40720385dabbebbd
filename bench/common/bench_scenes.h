// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_BENCH_SCENES_H
#define WEFT_BENCH_COMMON_BENCH_SCENES_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace weft::bench {

/// A scene to measure, made or read when it is its turn.
struct BenchScene {
    std::string name;
    std::function<Scene(Diagnostics&)> load;
    std::filesystem::path file{};  ///< empty for generated scenes
};

/// A lit room with a few boxes: 86 triangles.
[[nodiscard]] Scene box_scene();

/// A lit room whose floor is a rugged terrain of 2 `edge`^2 triangles.
[[nodiscard]] Scene terrain_scene(std::uint32_t edge);

/// The scenes of a run: `names` of DIR/<name>/<name>.xml where `folder` holds them (<name>-fog is
/// looked for beside <name>), then generated ones; without the largest where `quick`.
[[nodiscard]] std::vector<BenchScene> bench_scenes(const std::filesystem::path& folder,
                                                   const std::vector<std::string>& names,
                                                   bool quick);

}  // namespace weft::bench

#endif
