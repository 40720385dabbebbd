// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/tables/shipped_scenes.h"

#include <array>

#include "scene/load/load_scene.h"

namespace weft::bench {
namespace {

constexpr std::array<NamedScene, 11> shipped{{{"Cornell", "cornell-box.gltf"},
                                              {"Deskar", "deskar.gltf"},
                                              {"Subdivided", "subdivided.gltf"},
                                              {"Desk", "desk.gltf"},
                                              {"Sibenik", "sibenik.gltf"},
                                              {"Office", "office.gltf"},
                                              {"Conference", "conference.gltf"},
                                              {"Shirley6", "shirley6.gltf"},
                                              {"SubdividedPM", "subdivided-pm.gltf"},
                                              {"OfficePM", "office-pm.gltf"},
                                              {"Shirley6PM", "shirley6-pm.gltf"}}};
constexpr std::array<NamedScene, 8> real{{{"Cornell", "cornell-box"},
                                          {"Office", "office"},
                                          {"Desk", "desk"},
                                          {"Conference", "conference"},
                                          {"Sibenik", "sibenik"},
                                          {"", "cornell-box-fog"},
                                          {"OfficePM", "office-fog"},
                                          {"", "sibenik-fog"}}};

}  // namespace

std::span<const NamedScene> shipped_scenes() {
    return shipped;
}

std::span<const NamedScene> real_scenes() {
    return real;
}

std::vector<BenchScene> load_shipped_scenes(const std::filesystem::path& folder) {
    std::vector<BenchScene> scenes;
    for (const NamedScene& scene : shipped) {
        const std::filesystem::path file = folder / scene.name;
        if (!std::filesystem::is_regular_file(file)) continue;
        scenes.push_back(
            {std::string(scene.name),
             [file](Diagnostics& diagnostics) { return load_scene(file, diagnostics); }, file});
    }
    return scenes;
}

std::vector<BenchScene> load_real_scenes(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const NamedScene& scene : real) names.emplace_back(scene.name);
    std::vector<BenchScene> scenes = bench_scenes(folder, names, true);
    std::erase_if(scenes, [](const BenchScene& scene) { return scene.file.empty(); });
    return scenes;
}

std::string published_scene(std::string_view name) {
    for (const auto& list : {shipped_scenes(), real_scenes()})
        for (const NamedScene& scene : list)
            if (scene.name == name) return std::string(scene.published);
    return {};
}

}  // namespace weft::bench
