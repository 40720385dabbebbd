// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_scenes.h"

#include <algorithm>

#include "base/error.h"
#include "bench/common/child_process.h"
#include "scene/load/load_scene.h"

namespace weft::bench {
namespace {

/// Of those in bench/cross_validation/media_scenes.py the one that Mitsuba's `volpath` is for.
constexpr const char* grid_scene = "slab";

/// The file of that scene, or an empty path and a problem.
std::filesystem::path write_grid_scene(const PythonPrograms& programs,
                                       const std::filesystem::path& scratch, std::string& problem) {
    try {
        ChildProcess child({programs.python, "-B",
                            programs.folder / "cross_validation" / "media_scenes.py", grid_scene,
                            scratch.string()});
        const auto line = child.read_line();
        if (line && std::filesystem::is_regular_file(*line)) return *line;
        problem = line ? "its file is missing" : child.fate();
    } catch (const Error& error) {
        problem = error.what();
    }
    return {};
}

}  // namespace

std::vector<PathScene> path_scenes(const std::filesystem::path& folder,
                                   const std::vector<std::string>& only,
                                   const PythonPrograms& programs,
                                   const std::filesystem::path& scratch, std::string& problem) {
    const auto wanted = [&](const std::string& name) {
        return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
    };
    const std::vector<BenchScene> found = bench_scenes(
        folder,
        {"cornell-box", "sibenik", "conference", "office", "desk", "cornell-box-fog", "office-fog"},
        true);
    const bool files = !found.front().file.empty();
    std::vector<PathScene> scenes;
    for (const BenchScene& scene : found)
        if (wanted(scene.name) && (!files || !scene.file.empty()))
            scenes.push_back({scene, scene.name.ends_with("-fog")});
    if (!wanted(grid_scene)) return scenes;
    const std::filesystem::path file = write_grid_scene(programs, scratch, problem);
    if (file.empty()) return scenes;
    const auto load = [file](Diagnostics& diagnostics) { return load_scene(file, diagnostics); };
    scenes.push_back({{grid_scene, load, file}, true});
    return scenes;
}

}  // namespace weft::bench
