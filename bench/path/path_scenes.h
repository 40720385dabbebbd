// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_PATH_SCENES_H
#define WEFT_BENCH_PATH_PATH_SCENES_H

#include <filesystem>
#include <string>
#include <vector>

#include "bench/common/bench_scenes.h"
#include "bench/path/mitsuba_choice.h"

namespace weft::bench {

/// A scene of the benchmark.
struct PathScene {
    BenchScene scene;
    bool media = false;
};

/// The scenes of a run: files of `folder`, without and with fog, or generated scenes that only Weft
/// reads where it holds none; and one with a density grid, which a program in Python writes into
/// `scratch`. `only`: those of these names, where there are any. `problem` gets why the last one is
/// missing.
[[nodiscard]] std::vector<PathScene> path_scenes(const std::filesystem::path& folder,
                                                 const std::vector<std::string>& only,
                                                 const PythonPrograms& programs,
                                                 const std::filesystem::path& scratch,
                                                 std::string& problem);

/// Scenes with metals, plastics and glass, which a program in Python writes into `scratch`; `only`
/// and `problem` as above.
[[nodiscard]] std::vector<PathScene> path_material_scenes(const std::vector<std::string>& only,
                                                          const PythonPrograms& programs,
                                                          const std::filesystem::path& scratch,
                                                          std::string& problem);

}  // namespace weft::bench

#endif
