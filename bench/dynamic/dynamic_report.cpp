// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/dynamic_report.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <vector>

#include "bench/common/candidate.h"

namespace weft::bench {
namespace {

/// The numbers at a path of all frames from `first` on, of those that have one.
std::vector<double> series(const nlohmann::json& frames, const char* path, std::size_t first) {
    std::vector<double> values;
    for (std::size_t f = first; f < frames.size(); ++f)
        if (const auto value = number_at(frames[f], path)) values.push_back(*value);
    return values;
}

nlohmann::json mean(const std::vector<double>& values) {
    if (values.empty()) return {};
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Mean rays a frame of every class that any frame but the first has.
nlohmann::json mean_rays_by_class(const nlohmann::json& frames) {
    std::map<std::string, double> sums;
    for (std::size_t f = 1; f < frames.size(); ++f)
        for (const auto& [name, rays] : frames[f]["rays_by_class"].items())
            sums[name] += rays.get<double>();
    for (auto& [name, sum] : sums) sum /= static_cast<double>(frames.size() - 1);
    return nlohmann::json(sums);
}

std::string cell(const std::optional<double>& value, int width, int decimals) {
    return value ? fmt::format(" {:>{}.{}f}", *value, width, decimals)
                 : fmt::format(" {:>{}}", "-", width);
}

std::string class_line(const nlohmann::json& row) {
    std::string line = fmt::format("{:>45}:", row["method"].get<std::string>());
    for (const auto& [name, rays] : row["rays_by_class"].items())
        line += fmt::format(" {} {:.0f},", name, rays.get<double>());
    line.back() = '\n';
    return line;
}

/// Mean rays of all sequences, by method and class.
nlohmann::json rays_by_class(const nlohmann::json& sequences) {
    std::map<std::string, std::map<std::string, double>> sums;
    std::map<std::string, double> counts;
    for (const nlohmann::json& sequence : sequences)
        for (const nlohmann::json& row : sequence["methods"]) {
            const std::string method = row["method"];
            ++counts[method];
            for (const auto& [name, rays] : row["rays_by_class"].items())
                sums[method][name] += rays.get<double>();
        }
    for (auto& [method, classes] : sums)
        for (auto& [name, sum] : classes) sum /= counts[method];
    return nlohmann::json(sums);
}

}  // namespace

nlohmann::json stage_sums(const std::vector<StageStats>& stages, bool rays) {
    nlohmann::json sums = nlohmann::json::object();
    for (const StageStats& stage : stages) {
        if (rays && (stage.rays == 0 || stage.stage == Stage::primary_rays)) continue;
        nlohmann::json& sum = sums[std::string(stage_name(stage.stage))];
        if (rays)
            sum = (sum.is_null() ? 0 : sum.get<std::uint64_t>()) + stage.rays;
        else
            sum = (sum.is_null() ? 0.0 : sum.get<double>()) + stage.ms;
    }
    return sums;
}

nlohmann::json frame_json(const DynamicFrame& frame, const FrameErrors& errors) {
    nlohmann::json json{{"ms", frame.ms},
                        {"update_ms", frame.update_ms},
                        {"rays", frame.rays},
                        {"rays_by_class", stage_sums(frame.stages, true)},
                        {"ms_by_stage", stage_sums(frame.stages, false)},
                        {"errors", errors.json()}};
    if (const auto& cache = frame.cache)
        json["records"] = {{"kept", cache->kept},       {"updated", cache->updated},
                           {"dropped", cache->dropped}, {"evicted", cache->evicted},
                           {"made", cache->made},       {"bytes", cache->bytes}};
    return json;
}

nlohmann::json method_json(const DynamicMethod& method, const nlohmann::json& frames) {
    nlohmann::json json{{"method", method.name},
                        {"light", method.full ? "all" : "indirect"},
                        {"ms", median(series(frames, "/ms", 1))},
                        {"update_ms", median(series(frames, "/update_ms", 1))},
                        {"rays", mean(series(frames, "/rays", 1))},
                        {"rays_by_class", mean_rays_by_class(frames)}};
    json["errors"] = {
        {"relmse", mean(series(frames, "/errors/converged/relmse", 0))},
        {"relmse_trimmed", mean(series(frames, "/errors/converged/relmse_trimmed", 0))},
        {"vdp75", mean(series(frames, "/errors/converged/hdrvdp_published/p75", 0))},
        {"vdp75_display", mean(series(frames, "/errors/converged/hdrvdp_display/p75", 0))},
        {"relmse_same_vpls", mean(series(frames, "/errors/same_vpls/relmse", 0))}};
    json["flicker"] = {{"change", mean(series(frames, "/errors/flicker/change", 1))},
                       {"unsteady", mean(series(frames, "/errors/flicker/unsteady", 1))},
                       {"seen", mean(series(frames, "/errors/flicker/seen", 1))}};
    for (const char* const key : {"kept", "updated", "dropped", "made"}) {
        const auto values = series(frames, (std::string("/records/") + key).c_str(), 1);
        if (!values.empty()) json["records"][key] = mean(values);
    }
    json["frames"] = frames;
    return json;
}

std::string sequence_heading() {
    return fmt::format(
        "{:>12} {:>9} {:>16} {:>9} {:>12} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
        "scene", "what", "method", "ms", "rays", "kept", "made", "VDP 75 %", "display", "relMSE",
        "same VPLs", "flicker", "seen %");
}

std::string sequence_table(const nlohmann::json& sequence) {
    std::string lines;
    for (const nlohmann::json& row : sequence["methods"]) {
        lines +=
            fmt::format("{:>12} {:>9} {:>16}", sequence["scene"].get<std::string>(),
                        sequence["happening"].get<std::string>(), row["method"].get<std::string>());
        lines += cell(number_at(row, "/ms"), 9, 1) + cell(number_at(row, "/rays"), 12, 0) +
                 cell(number_at(row, "/records/kept"), 9, 0) +
                 cell(number_at(row, "/records/made"), 9, 0) +
                 cell(number_at(row, "/errors/vdp75"), 9, 2) +
                 cell(number_at(row, "/errors/vdp75_display"), 9, 2) +
                 cell(number_at(row, "/errors/relmse"), 9, 5) +
                 cell(number_at(row, "/errors/relmse_same_vpls"), 9, 5) +
                 cell(number_at(row, "/flicker/change"), 9, 4) +
                 cell(number_at(row, "/flicker/seen"), 9, 2) + "\n";
    }
    for (const nlohmann::json& row : sequence["methods"]) lines += class_line(row);
    return lines;
}

nlohmann::json sequence_summary(const nlohmann::json& sequences) {
    const auto ratio = [&](const char* above, const char* below, const char* path,
                           const std::string& event) {
        return mean_ratio(sequences, above, below, path, event);
    };
    nlohmann::json summary{
        {"ic_vs_igi", ratio("igi", "ic", "/ms", "still")},
        {"ic_vs_irradiance_cache", ratio("irradiance-cache", "ic", "/ms", "still")},
        {"tic_vs_ic_rays", ratio("ic", "tic", "/rays", "box")},
        {"tic_vs_ic_ms", ratio("ic", "tic", "/ms", "box")},
        {"tic_vs_igi_ms", ratio("igi", "tic", "/ms", "")},
        {"masks_rays", ratio("tic, no masks", "tic", "/rays", "")},
        {"ais_tic_vs_ais_ms", ratio("ais", "ais, tic", "/ms", "")},
        {"flicker_tic_vs_igi", ratio("tic", "igi", "/flicker/change", "")},
        {"seen_flicker_tic_vs_igi", ratio("tic", "igi", "/flicker/seen", "")},
        {"relmse_tic_vs_igi", ratio("tic", "igi", "/errors/relmse", "")},
        {"rays_by_class", rays_by_class(sequences)}};
    std::set<std::string> events;
    for (const nlohmann::json& sequence : sequences) events.insert(sequence["happening"]);
    for (const std::string& event : events)
        summary["by_happening"][event] = {
            {"tic_vs_ic_rays", ratio("ic", "tic", "/rays", event)},
            {"tic_vs_ic_ms", ratio("ic", "tic", "/ms", event)},
            {"tic_vs_igi_ms", ratio("igi", "tic", "/ms", event)},
            {"flicker_tic_vs_igi", ratio("tic", "igi", "/flicker/change", event)}};
    return summary;
}

std::string validation_table(const nlohmann::json& sequence) {
    std::string lines;
    for (const nlohmann::json& row : sequence["methods"])
        lines += fmt::format(
            "{:>12} {:>9} {:>16} {:>9} {:>12} {:>9} {:>14} {:>14}\n",
            sequence["scene"].get<std::string>(), sequence["happening"].get<std::string>(),
            row["method"].get<std::string>(), row["frames"].get<std::uint64_t>(),
            row["compared"].get<std::uint64_t>(), row["differing"].get<std::uint64_t>(),
            row["connections_traced"].get<std::uint64_t>(),
            row["connections_affected"].get<std::uint64_t>());
    return lines;
}

nlohmann::json validation_summary(const nlohmann::json& sequences) {
    std::map<std::string, std::uint64_t> sums{{"frames", 0}, {"compared", 0}, {"differing", 0}};
    for (const nlohmann::json& sequence : sequences)
        for (const nlohmann::json& row : sequence["methods"])
            for (auto& [key, sum] : sums) sum += row[key].get<std::uint64_t>();
    return nlohmann::json(sums);
}

const nlohmann::json* find_method(const nlohmann::json& methods, const std::string& name) {
    for (const nlohmann::json& row : methods)
        if (row["method"] == name) return &row;
    return nullptr;
}

std::optional<double> number_at(const nlohmann::json& json, const char* path) {
    const nlohmann::json::json_pointer pointer(path);
    if (!json.contains(pointer) || !json[pointer].is_number()) return std::nullopt;
    return json[pointer].get<double>();
}

nlohmann::json mean_ratio(const nlohmann::json& rows, const std::string& above,
                          const std::string& below, const char* path, const std::string& event) {
    std::vector<double> ratios;
    for (const nlohmann::json& row : rows) {
        if (!event.empty() && row["happening"] != event) continue;
        const nlohmann::json* const a = find_method(row["methods"], above);
        const nlohmann::json* const b = find_method(row["methods"], below);
        if (a == nullptr || b == nullptr) continue;
        const auto numerator = number_at(*a, path);
        const auto denominator = number_at(*b, path);
        if (numerator && denominator && *denominator > 0.0)
            ratios.push_back(*numerator / *denominator);
    }
    return mean(ratios);
}

}  // namespace weft::bench
