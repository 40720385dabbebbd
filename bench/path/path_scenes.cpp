// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_scenes.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"
#include "bench/common/child_process.h"
#include "scene/load/load_scene.h"

namespace weft::bench {
namespace {

/// Of those in bench/cross_validation/media_scenes.py the one that Mitsuba's `volpath` is for.
constexpr const char* grid_scene = "slab";
constexpr const char* grid_program = "cross_validation/media_scenes.py";

/// Of those in bench/witness/witness_scenes.py one for each kind of lobe.
constexpr std::array<std::string_view, 9> material_scenes = {
    "conductor-gold",       "roughconductor-ggx-0.2",  "roughconductor-beckmann-0.1",
    "dielectric",           "roughdielectric-ggx-0.2", "plastic",
    "roughplastic-ggx-0.1", "normalmap-metal",         "mirrors"};
constexpr const char* material_program = "witness/witness_scenes.py";

/// The file of a scene that a program in Python writes, or an empty path and a problem.
std::filesystem::path write_scene(const PythonPrograms& programs, const char* program,
                                  const std::string& name, const std::filesystem::path& scratch,
                                  std::string& problem) {
    try {
        ChildProcess child(
            {programs.python, "-B", programs.folder / program, name, scratch.string()});
        const auto line = child.read_line();
        if (line && std::filesystem::is_regular_file(*line)) return *line;
        problem = line ? "its file is missing" : child.fate();
    } catch (const Error& error) {
        problem = error.what();
    }
    return {};
}

}  // namespace

std::vector<PathScene> path_material_scenes(const std::vector<std::string>& only,
                                            const PythonPrograms& programs,
                                            const std::filesystem::path& scratch,
                                            std::string& problem) {
    std::vector<PathScene> scenes;
    for (const std::string_view view : material_scenes) {
        const std::string name(view);
        if (!only.empty() && std::find(only.begin(), only.end(), name) == only.end()) continue;
        const std::filesystem::path file =
            write_scene(programs, material_program, name, scratch, problem);
        if (file.empty()) continue;
        const auto load = [file](Diagnostics& diagnostics) {
            return load_scene(file, diagnostics);
        };
        scenes.push_back({{name, load, file}, false});
    }
    return scenes;
}

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
    const std::filesystem::path file =
        write_scene(programs, grid_program, grid_scene, scratch, problem);
    if (file.empty()) return scenes;
    const auto load = [file](Diagnostics& diagnostics) { return load_scene(file, diagnostics); };
    scenes.push_back({{grid_scene, load, file}, true});
    return scenes;
}

}  // namespace weft::bench
