// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace weft::bench {
namespace {

/// Which scenes a mean is over.
enum class Scenes : std::uint8_t { all, surfaces, media };

std::string cell(double number) {
    return number > 0.0 ? fmt::format("{:9.2f}", number) : fmt::format("{:>9}", "-");
}

std::string cell(const Ratio& ratio) {
    return fmt::format("{:9.2f} ±{:4.0f} %", ratio.value, 100.0 * ratio.spread);
}

/// Weft's candidates that any result holds, in the order in which they come.
std::vector<CandidateName> own_candidates(const std::vector<PathResult>& results) {
    std::vector<CandidateName> found;
    for (const PathResult& result : results)
        for (const PathFigures& figures : result.candidates)
            if (!figures.is_mitsuba() &&
                std::find(found.begin(), found.end(), figures.candidate_name) == found.end())
                found.push_back(figures.candidate_name);
    return found;
}

/// What was measured of a candidate against Mitsuba, scene by scene.
std::vector<AgainstMitsuba> measured(const std::vector<PathResult>& results,
                                     const CandidateName& candidate_name, Scenes scenes) {
    std::vector<AgainstMitsuba> found;
    for (const PathResult& result : results) {
        if (scenes != Scenes::all && result.media != (scenes == Scenes::media)) continue;
        for (const PathFigures& figures : result.candidates)
            if (figures.candidate_name == candidate_name && figures.against)
                found.push_back(*figures.against);
    }
    return found;
}

std::vector<Ratio> values(const std::vector<AgainstMitsuba>& all, Ratio AgainstMitsuba::*value) {
    std::vector<Ratio> found;
    for (const AgainstMitsuba& one : all) found.push_back(one.*value);
    return found;
}

nlohmann::json mean_json(const std::vector<AgainstMitsuba>& all, Ratio AgainstMitsuba::*value) {
    if (all.empty()) return {};
    return geometric_mean(values(all, value)).value;
}

void add_ratio(nlohmann::json& json, const std::string& key, const Ratio& ratio) {
    json[key] = ratio.value;
    json[key + "_spread"] = ratio.spread;
}

void add_ratios(nlohmann::json& json, const AgainstMitsuba& against) {
    add_ratio(json, "variance_ratio", against.variance);
    add_ratio(json, "time_ratio", against.time);
    add_ratio(json, "efficiency_vs_mitsuba", against.efficiency);
    add_ratio(json, "cpu_ratio", against.processor);
    add_ratio(json, "cpu_efficiency", against.processor_efficiency);
}

nlohmann::json candidate_json(const PathFigures& figures) {
    nlohmann::json ms = nlohmann::json::array();
    nlohmann::json cpu = nlohmann::json::array();
    for (const Timing& timing : figures.runs) {
        ms.push_back(timing.ms);
        cpu.push_back(timing.cpu_ms);
    }
    nlohmann::json json{{"name", figures.candidate_name.name()},
                        {"algorithm", figures.candidate_name.algorithm},
                        {"backend", figures.candidate_name.backend},
                        {"yardstick", figures.is_mitsuba()},
                        {"available", figures.problem.empty()},
                        {"ms", ms},
                        {"cpu_ms", cpu}};
    if (!figures.problem.empty()) {
        json["problem"] = figures.problem;
        return json;
    }
    json["msamples"] = figures.msamples;
    json["mean"] = figures.mean;
    add_ratio(json, "relative_variance", figures.variance);
    if (!figures.is_mitsuba()) json["mrays"] = figures.mrays;
    if (!figures.against) return json;
    add_ratios(json, *figures.against);
    const Agreement& means = figures.against->means;
    json["worst_z"] = means.worst_z;
    json["mean_difference"] = means.difference;
    json["mean_difference_error"] = means.error;
    return json;
}

/// The means of one candidate.
nlohmann::json means_json(const std::vector<PathResult>& results,
                          const CandidateName& candidate_name) {
    nlohmann::json json{{"algorithm", candidate_name.algorithm},
                        {"backend", candidate_name.backend}};
    const auto all = measured(results, candidate_name, Scenes::all);
    json["scenes"] = all.size();
    if (all.empty()) return json;
    AgainstMitsuba means;
    for (Ratio AgainstMitsuba::*const value :
         {&AgainstMitsuba::variance, &AgainstMitsuba::time, &AgainstMitsuba::processor,
          &AgainstMitsuba::efficiency, &AgainstMitsuba::processor_efficiency})
        means.*value = geometric_mean(values(all, value));
    add_ratios(json, means);
    json["efficiency_min"] = std::min_element(all.begin(), all.end(),
                                              [](const AgainstMitsuba& a, const AgainstMitsuba& b) {
                                                  return a.efficiency.value < b.efficiency.value;
                                              })
                                 ->efficiency.value;
    json["efficiency_without_media"] =
        mean_json(measured(results, candidate_name, Scenes::surfaces), &AgainstMitsuba::efficiency);
    json["efficiency_with_media"] =
        mean_json(measured(results, candidate_name, Scenes::media), &AgainstMitsuba::efficiency);
    return json;
}

/// "path" on OpenCL, which is the default, and "native_path" on another backend.
std::string key_of(const CandidateName& candidate_name) {
    return (candidate_name.backend == "opencl" ? "" : candidate_name.backend + "_") +
           candidate_name.algorithm;
}

/// The smallest and the mean ratio of times over the scenes, under the names they have always had.
void add_times(nlohmann::json& summary, const std::string& key, const std::vector<Ratio>& ratios) {
    summary[key] = {};
    summary[key + "_mean"] = {};
    if (ratios.empty()) return;
    double least = ratios.front().value;
    double sum = 0.0;
    for (const Ratio& ratio : ratios) {
        least = std::min(least, ratio.value);
        sum += ratio.value;
    }
    summary[key] = least;
    summary[key + "_mean"] = sum / static_cast<double>(ratios.size());
}

}  // namespace

std::string path_heading() {
    std::string text =
        "Weft's algorithms of the path family next to Mitsuba 3. variance: of an image, relative.\n"
        "Ratios are Mitsuba's over Weft's, above 1 is better: of variances, of times, and\n"
        "efficiency, the product of both. ±: standard error. mean: difference of images' means\n"
        "to Mitsuba's; |z|: the largest of their blocks of pixels.\n\n";
    return text + fmt::format("{:16} {:20}{:>9}{:>9}{:>9}{:>17}{:>17}{:>17}{:>17}{:>7}\n", "scene",
                              "candidate", "Ms/s", "Mr/s", "variance", "variance ratio",
                              "time ratio", "efficiency", "mean, %", "|z|");
}

std::string path_rows(const PathResult& result, double z_limit) {
    std::string text;
    for (const PathFigures& figures : result.candidates) {
        if (!figures.ran()) continue;
        text += fmt::format("{:16} {:20}", text.empty() ? result.name : "",
                            figures.candidate_name.name());
        text += cell(figures.msamples) + cell(figures.mrays) +
                fmt::format("{:9.4f}", figures.variance.value);
        if (figures.against) {
            const AgainstMitsuba& against = *figures.against;
            text += cell(against.variance) + cell(against.time) + cell(against.efficiency);
            text += fmt::format("{:+8.2f} ± {:5.2f} {:6.1f}{}", 100.0 * against.means.difference,
                                100.0 * against.means.error, against.means.worst_z,
                                against.means.worst_z > z_limit ? "!" : "");
        }
        text += "\n";
    }
    return text;
}

std::string path_means(const std::vector<PathResult>& results) {
    std::string text;
    for (const CandidateName& candidate_name : own_candidates(results)) {
        const auto all = measured(results, candidate_name, Scenes::all);
        if (all.empty()) continue;
        text += fmt::format("{:16} {:20}{:27}", text.empty() ? "geometric mean" : "",
                            candidate_name.name(), "");
        for (Ratio AgainstMitsuba::*const value :
             {&AgainstMitsuba::variance, &AgainstMitsuba::time, &AgainstMitsuba::efficiency})
            text += cell(geometric_mean(values(all, value)));
        text += "\n";
    }
    return text;
}

nlohmann::json path_json(const PathResult& result) {
    nlohmann::json candidates = nlohmann::json::array();
    for (const PathFigures& figures : result.candidates)
        candidates.push_back(candidate_json(figures));
    return {{"name", result.name},
            {"media", result.media},
            {"triangles", result.triangles},
            {"candidates", candidates}};
}

nlohmann::json path_summary(const std::vector<PathResult>& results, double z_limit) {
    nlohmann::json summary;
    summary["means"] = nlohmann::json::array();
    nlohmann::json worst;
    for (const CandidateName& candidate_name : own_candidates(results)) {
        const auto all = measured(results, candidate_name, Scenes::all);
        const std::string key = key_of(candidate_name);
        summary["means"].push_back(means_json(results, candidate_name));
        summary[key + "_efficiency_vs_mitsuba"] = mean_json(all, &AgainstMitsuba::efficiency);
        add_times(summary, key + "_vs_mitsuba", values(all, &AgainstMitsuba::time));
        add_times(summary, key + "_vs_mitsuba_cpu", values(all, &AgainstMitsuba::processor));
        for (const AgainstMitsuba& one : all)
            if (worst.is_null() || one.means.worst_z > worst.get<double>())
                worst = one.means.worst_z;
    }
    summary["worst_z"] = worst;
    summary["z_limit"] = z_limit;
    summary["means_agree"] =
        worst.is_null() ? nlohmann::json() : nlohmann::json(worst.get<double>() <= z_limit);
    return summary;
}

}  // namespace weft::bench
