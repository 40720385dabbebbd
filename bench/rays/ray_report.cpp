// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/rays/ray_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace weft::bench {
namespace {

struct Column {
    const char* title;
    const char* candidate;
};

constexpr std::array columns{
    Column{"opencl", candidate_opencl},   Column{"native", candidate_native},
    Column{"rob 1", "robust 1"},          Column{"rob 8", "robust 8"},
    Column{"rob 16", "robust 16"},        Column{"def 1", "default 1"},
    Column{"def 8", "default 8"},         Column{"def 16", "default 16"},
    Column{"rc 8", "robust coherent 8"},  Column{"rc 16", "robust coherent 16"},
    Column{"dc 8", "default coherent 8"}, Column{"dc 16", "default coherent 16"},
};

std::string number(const Figures* figures) {
    return figures == nullptr ? fmt::format("{:>8}", "-") : fmt::format("{:8.2f}", figures->mrays);
}

std::string ratio_text(const SetResult& set, const char* candidate, double Timing::*value) {
    const Figures* const own = set.find(candidate);
    if (own == nullptr) return fmt::format("{:>8}", "-");
    return fmt::format("{:8.3f}", ratio_to_best(*own, set.figures, value).ratio);
}

/// How far the answers agree: rays that OpenCL answers differently, and at most any yardstick.
std::string agreement(const SetResult& set) {
    const Figures* const opencl = set.find(candidate_opencl);
    std::uint64_t yardsticks = 0;
    for (const Figures& figures : set.figures)
        if (figures.is_yardstick) yardsticks = std::max(yardsticks, figures.differing);
    return fmt::format("{:>7}{:>8}", opencl == nullptr ? "-" : std::to_string(opencl->differing),
                       yardsticks);
}

/// Smallest ratio of a candidate on a ray set over the scenes.
nlohmann::json smallest_ratio(const std::vector<SceneResult>& scenes, const std::string& set_name,
                              const std::string& candidate, double Timing::*value = &Timing::ms) {
    nlohmann::json smallest;
    for (const SceneResult& scene : scenes)
        for (const SetResult& set : scene.sets) {
            const Figures* const own = set.find(candidate);
            if (set.name != set_name || own == nullptr) continue;
            const double ratio = ratio_to_best(*own, set.figures, value).ratio;
            if (smallest.is_null() || ratio < smallest.get<double>()) smallest = ratio;
        }
    return smallest;
}

nlohmann::json figures_json(const Figures& figures, const SetResult& set) {
    nlohmann::json ms = nlohmann::json::array();
    nlohmann::json wall = nlohmann::json::array();
    nlohmann::json cpu = nlohmann::json::array();
    for (const Timing& timing : figures.runs) {
        ms.push_back(timing.ms);
        wall.push_back(timing.wall_ms);
        cpu.push_back(timing.cpu_ms);
    }
    nlohmann::json json{{"name", figures.name},
                        {"yardstick", figures.is_yardstick},
                        {"ms", ms},
                        {"wall_ms", wall},
                        {"cpu_ms", cpu},
                        {"mrays", figures.mrays},
                        {"wall_mrays", figures.wall_mrays},
                        {"hits", figures.hits},
                        {"id_sum", figures.id_sum},
                        {"differing", figures.differing}};
    if (!figures.is_yardstick) {
        const YardstickRatio best = ratio_to_best(figures, set.figures);
        json["ratio"] = best.ratio;
        json["ratio_to"] = best.yardstick;
        json["cpu_ratio"] = ratio_to_best(figures, set.figures, &Timing::cpu_ms).ratio;
    }
    return json;
}

}  // namespace

const Figures* SetResult::find(const std::string& candidate) const {
    const auto found = std::find_if(figures.begin(), figures.end(),
                                    [&](const Figures& f) { return f.name == candidate; });
    return found == figures.end() ? nullptr : &*found;
}

std::string table_legend() {
    return "Million rays per second, medians of interleaved runs. opencl and native: Weft's own\n"
           "traversal (opencl: event times; wall: as the host sees it). Embree 1, 8 and 16 wide:\n"
           "rob robust mode, def default mode, rc and dc the same with COHERENT. The yardstick is\n"
           "rob 1 for single rays, and the fastest of the three rob columns for packets.\n"
           "o/yard and n/yard: opencl and native against it, o/cpu and n/cpu the same by "
           "processor\n"
           "time, which matters where the machine is busy otherwise.\n"
           "differ: answers other than native's, of opencl and of the yardstick.\n";
}

std::string table_heading(const SceneResult& scene) {
    std::string text =
        fmt::format("\n{}: {} triangles, BVH of {} nodes in {:.0f} ms, SAH {:.1f}\n", scene.name,
                    scene.triangles, scene.bvh_nodes, scene.bvh_ms, scene.sah_cost);
    text += fmt::format("{:8}{:>9}", "set", "rays");
    for (const Column& column : columns) text += fmt::format("{:>8}", column.title);
    return text + fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>15}\n", "wall", "o/yard", "n/yard",
                              "o/cpu", "n/cpu", "differ");
}

std::string table_row(const SetResult& set) {
    std::string text = fmt::format("{:8}{:>9}", set.name, set.rays);
    for (const Column& column : columns) text += number(set.find(column.candidate));
    const Figures* const opencl = set.find(candidate_opencl);
    text +=
        opencl == nullptr ? fmt::format("{:>8}", "-") : fmt::format("{:8.2f}", opencl->wall_mrays);
    for (const auto value : {&Timing::ms, &Timing::cpu_ms})
        for (const char* const candidate : {candidate_opencl, candidate_native})
            text += ratio_text(set, candidate, value);
    return text + agreement(set) + "\n";
}

nlohmann::json scene_json(const SceneResult& scene) {
    nlohmann::json sets = nlohmann::json::array();
    for (const SetResult& set : scene.sets) {
        nlohmann::json candidates = nlohmann::json::array();
        for (const Figures& figures : set.figures) candidates.push_back(figures_json(figures, set));
        sets.push_back({{"name", set.name}, {"rays", set.rays}, {"contenders", candidates}});
    }
    return {{"name", scene.name},           {"triangles", scene.triangles},
            {"bvh_nodes", scene.bvh_nodes}, {"bvh_ms", scene.bvh_ms},
            {"sah_cost", scene.sah_cost},   {"sets", sets}};
}

nlohmann::json summary_json(const std::vector<SceneResult>& scenes) {
    nlohmann::json summary;
    const std::array<std::pair<const char*, const char*>, 4> sets{
        {{"single_closest_min", set_closest},
         {"single_any_min", set_any},
         {"packet_any_min", set_packets},
         {"primary_closest_min", set_primary}}};
    for (const auto& [key, set] : sets) {
        const std::string name = key;
        summary[name] = smallest_ratio(scenes, set, candidate_opencl);
        summary[name + "_cpu"] = smallest_ratio(scenes, set, candidate_opencl, &Timing::cpu_ms);
        summary["native_" + name] = smallest_ratio(scenes, set, candidate_native);
    }
    return summary;
}

}  // namespace weft::bench
