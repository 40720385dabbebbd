// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace weft::bench {
namespace {

constexpr std::array own{paths_opencl, paths_native, paths_embree};
constexpr std::array mitsuba{paths_scalar, paths_llvm};

std::string cell(const nlohmann::json& number) {
    return number.is_null() ? fmt::format("{:>8}", "-")
                            : fmt::format("{:8.2f}", number.get<double>());
}

/// Takes a candidate's repetitions together; one that dropped out keeps none.
void conclude(PathFigures& result, double mean_sum, std::uint64_t rays, std::uint64_t samples) {
    Figures& figures = result.figures;
    if (!result.problem.empty()) {
        figures.runs.clear();
        figures.is_yardstick = false;
        return;
    }
    std::vector<double> ms;
    for (const Timing& timing : figures.runs) ms.push_back(timing.ms);
    const double middle = median(ms);
    if (middle > 0.0) {
        result.msamples = static_cast<double>(samples) * 1e-3 / middle;
        figures.mrays = static_cast<double>(rays) * 1e-3 / middle;
        figures.wall_mrays = figures.mrays;
    }
    result.mean = mean_sum / static_cast<double>(figures.runs.size());
}

/// Largest relative difference of any mean to the first, in per cent; null for a single one.
nlohmann::json spread(const PathResult& result) {
    nlohmann::json most;
    const PathFigures* first = nullptr;
    for (const PathFigures& candidate : result.candidates) {
        if (candidate.figures.runs.empty()) continue;
        if (first == nullptr) {
            first = &candidate;
            continue;
        }
        const double difference = 100.0 * std::abs(candidate.mean / first->mean - 1.0);
        if (most.is_null() || difference > most.get<double>()) most = difference;
    }
    return most;
}

nlohmann::json candidate_json(const PathFigures& candidate, const PathResult& scene) {
    nlohmann::json ms = nlohmann::json::array();
    nlohmann::json cpu = nlohmann::json::array();
    for (const Timing& timing : candidate.figures.runs) {
        ms.push_back(timing.ms);
        cpu.push_back(timing.cpu_ms);
    }
    nlohmann::json json{{"name", candidate.figures.name},
                        {"yardstick", candidate.figures.is_yardstick},
                        {"available", candidate.problem.empty()},
                        {"ms", ms},
                        {"cpu_ms", cpu}};
    if (!candidate.problem.empty()) {
        json["problem"] = candidate.problem;
        return json;
    }
    json["msamples"] = candidate.msamples;
    json["mean"] = candidate.mean;
    if (candidate.figures.is_yardstick) return json;
    json["mrays"] = candidate.figures.mrays;
    json["ratio"] = scene.ratio(candidate.figures.name);
    json["cpu_ratio"] = scene.ratio(candidate.figures.name, &Timing::cpu_ms);
    return json;
}

}  // namespace

const PathFigures* PathResult::find(const std::string& wanted) const {
    for (const PathFigures& candidate : candidates)
        if (candidate.figures.name == wanted && !candidate.figures.runs.empty()) return &candidate;
    return nullptr;
}

nlohmann::json PathResult::ratio(const std::string& wanted, double Timing::*value) const {
    const PathFigures* const ours = find(wanted);
    std::vector<Figures> all;
    for (const PathFigures& candidate : candidates)
        if (candidate.figures.is_yardstick) all.push_back(candidate.figures);
    if (ours == nullptr || all.empty()) return {};
    return ratio_to_best(ours->figures, all, value).ratio;
}

std::vector<PathFigures> measure_paths(
    const std::vector<std::unique_ptr<PathCandidate>>& candidates, std::uint64_t samples,
    std::uint32_t repetitions) {
    std::vector<PathFigures> results(candidates.size());
    std::vector<double> means(candidates.size());
    std::vector<std::uint64_t> rays(candidates.size());
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const std::string name = candidates[c]->name();
        results[c].figures.name = name;
        results[c].figures.is_yardstick =
            std::find(mitsuba.begin(), mitsuba.end(), name) != mitsuba.end();
    }
    for (std::uint32_t repetition = 0; repetition <= repetitions; ++repetition)
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            candidates[c]->prepare();
            const auto run = candidates[c]->run();
            results[c].problem = candidates[c]->problem();
            if (!run || repetition == 0) continue;
            results[c].figures.runs.push_back(run->timing);
            means[c] += run->mean;
            rays[c] = run->rays;
        }
    for (std::size_t c = 0; c < candidates.size(); ++c)
        conclude(results[c], means[c], rays[c], samples);
    return results;
}

std::string path_heading() {
    std::string text =
        "Million samples per second of Weft (opencl, native, embree; Mr/s: million rays) and of\n"
        "Mitsuba 3's variants, medians of interleaved runs. o/best, n/best and e/best: opencl,\n"
        "native and embree against the fastest variant, o/cpu the first by processor time.\n"
        "mean: largest difference of an image's mean to that of the first, in per cent.\n\n";
    text += fmt::format("{:14}{:>9}", "scene", "triangles");
    for (const char* const name : own) text += fmt::format("{:>8}{:>8}", name, "Mr/s");
    for (const char* const name : mitsuba) text += fmt::format("{:>12}", name);
    return text + fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}\n", "o/best", "n/best", "e/best", "o/cpu",
                              "mean");
}

std::string path_row(const PathResult& result) {
    std::string text = fmt::format("{:14}{:>9}", result.name, result.triangles);
    for (const char* const name : own) {
        const PathFigures* const found = result.find(name);
        text += cell(found ? nlohmann::json(found->msamples) : nlohmann::json());
        text += cell(found ? nlohmann::json(found->figures.mrays) : nlohmann::json());
    }
    for (const char* const name : mitsuba) {
        const PathFigures* const found = result.find(name);
        text += "    " + cell(found ? nlohmann::json(found->msamples) : nlohmann::json());
    }
    for (const char* const name : own) text += cell(result.ratio(name));
    return text + cell(result.ratio(paths_opencl, &Timing::cpu_ms)) + cell(spread(result)) + "\n";
}

nlohmann::json path_json(const PathResult& result) {
    nlohmann::json candidates = nlohmann::json::array();
    for (const PathFigures& candidate : result.candidates)
        candidates.push_back(candidate_json(candidate, result));
    return {{"name", result.name},
            {"triangles", result.triangles},
            {"mean_spread_percent", spread(result)},
            {"contenders", candidates}};
}

nlohmann::json path_summary(const std::vector<PathResult>& results) {
    nlohmann::json summary;
    const auto add = [&](const std::string& key, const char* candidate, double Timing::*value) {
        std::vector<double> ratios;
        for (const PathResult& result : results) {
            const nlohmann::json ratio = result.ratio(candidate, value);
            if (!ratio.is_null()) ratios.push_back(ratio.get<double>());
        }
        double sum = 0.0;
        for (const double ratio : ratios) sum += ratio;
        summary[key] = {};
        summary[key + "_mean"] = {};
        if (ratios.empty()) return;
        summary[key] = *std::min_element(ratios.begin(), ratios.end());
        summary[key + "_mean"] = sum / static_cast<double>(ratios.size());
    };
    add("path_vs_mitsuba", paths_opencl, &Timing::ms);
    add("path_vs_mitsuba_cpu", paths_opencl, &Timing::cpu_ms);
    add("native_path_vs_mitsuba", paths_native, &Timing::ms);
    add("embree_path_vs_mitsuba", paths_embree, &Timing::ms);
    return summary;
}

}  // namespace weft::bench
