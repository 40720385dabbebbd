// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_DYNAMIC_RUN_H
#define WEFT_BENCH_DYNAMIC_DYNAMIC_RUN_H

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "bench/common/bench_scenes.h"
#include "bench/dynamic/dynamic_methods.h"
#include "bench/dynamic/dynamic_sequences.h"
#include "bench/dynamic/scene_probe.h"
#include "device/executor.h"
#include "scene/scene.h"

namespace weft::bench {

/// In which frames HDR-VDP is asked.
enum class Visible : std::uint8_t { none, last, all };

/// How sequences are made.
struct DynamicRun {
    std::uint32_t edge = 512;     ///< of the image, pixels
    std::uint32_t frames = 12;    ///< at least 3
    std::uint32_t converged = 8;  ///< frames of `ir` that make a converged one
    Visible visible = Visible::all;
    std::filesystem::path images{};  ///< folder for small images of some frames; or empty
};

/// A scene that sequences are made of, at rest.
struct DynamicScene {
    std::string name;
    Scene scene;
    Camera camera;
    std::unique_ptr<SceneProbe> probe;
};
[[nodiscard]] DynamicScene load_dynamic_scene(const BenchScene& source, Diagnostics& diagnostics);

/// Renders a sequence by all methods, which take turns frame by frame, and judges every frame:
/// scene, event and, by method, means and all frames. See dynamic_report.h.
[[nodiscard]] nlohmann::json measure_sequence(const DynamicScene& scene, Event event,
                                              const std::vector<DynamicMethod>& methods,
                                              const DynamicRun& run, Executor& executor);

/// Renders a sequence by those of the methods whose records outlast their frame, and after every
/// change computes all records and VPLs anew: scene, event and, by method, how many were
/// compared and how many differ in any bit.
[[nodiscard]] nlohmann::json validate_sequence(const DynamicScene& scene, Event event,
                                               const std::vector<DynamicMethod>& methods,
                                               const DynamicRun& run, Executor& executor);

}  // namespace weft::bench

#endif
