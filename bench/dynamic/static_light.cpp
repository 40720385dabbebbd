// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/static_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "base/stopwatch.h"
#include "bench/common/candidate.h"
#include "bench/dynamic/dynamic_report.h"
#include "render/renderer.h"
#include "tradeoff/image_errors.h"

namespace weft::bench {
namespace {

/// All frames of one method.
struct StaticMethod {
    DynamicMethod method;
    std::vector<double> ms{};
    std::vector<double> rays{};
    std::map<std::string, double> rays_by_class{};
    std::vector<double> path_errors{}, path_trimmed{}, ir_errors{};
    ImageErrors first{};  ///< of its first frame, against the path-traced image
};

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Standard error of the mean.
double uncertainty(const std::vector<double>& values) {
    if (values.size() < 2) return 0.0;
    const double centre = mean(values);
    double squares = 0.0;
    for (const double value : values) squares += (value - centre) * (value - centre);
    const auto count = static_cast<double>(values.size());
    return std::sqrt(squares / (count - 1.0) / count);
}

void add(std::vector<double>& values, const std::optional<double>& value) {
    if (value) values.push_back(*value);
}

void judge(StaticMethod& entrant, const Image& image, const StaticReferences& references) {
    const bool first = entrant.ms.size() == 1;
    const ImageErrors errors = image_errors(references.path, image, "indirect", {first, first});
    add(entrant.path_errors, errors.relmse);
    add(entrant.path_trimmed, errors.relmse_trimmed);
    if (first) entrant.first = errors;
    add(entrant.ir_errors, image_errors(references.ir, image, "indirect", {false, false}).relmse);
}

/// One frame with random numbers of its own.
void measure(StaticMethod& entrant, Executor& executor, const FlatScene& flat, const Camera& camera,
             const StaticReferences& references, std::uint32_t edge, std::uint32_t seed) {
    Renderer renderer(executor, flat, camera, dynamic_settings(entrant.method, edge, seed));
    // The first frame compiles kernels and touches new memory.
    (void)renderer.render_frame({});
    renderer.set_camera(camera);
    const weft::Stopwatch watch;
    (void)renderer.render_frame({});
    entrant.ms.push_back(watch.total());
    const FrameStats& stats = renderer.stats().back();
    entrant.rays.push_back(static_cast<double>(stats.rays - std::uint64_t{edge} * edge));
    const nlohmann::json sums = stage_sums(stats.stages, true);
    for (const auto& [name, rays] : sums.items()) entrant.rays_by_class[name] += rays.get<double>();
    judge(entrant, renderer.image(), references);
}

nlohmann::json errors_json(const std::vector<double>& values) {
    if (values.empty()) return {};
    return {{"mean", mean(values)}, {"uncertainty", uncertainty(values)}, {"all", values}};
}

nlohmann::json row_of(const StaticMethod& entrant) {
    nlohmann::json rays = nlohmann::json::object();
    for (const auto& [name, sum] : entrant.rays_by_class)
        rays[name] = sum / static_cast<double>(entrant.ms.size());
    return {{"method", entrant.method.name},
            {"ms", median(entrant.ms)},
            {"all_ms", entrant.ms},
            {"rays", mean(entrant.rays)},
            {"rays_by_class", rays},
            {"relmse_path", errors_json(entrant.path_errors)},
            {"relmse_trimmed_path", errors_json(entrant.path_trimmed)},
            {"relmse_ir", errors_json(entrant.ir_errors)},
            {"first_frame", entrant.first.json()}};
}

}  // namespace

Image many_vpls(Executor& executor, const FlatScene& flat, const Camera& camera, std::uint32_t edge,
                std::uint32_t count) {
    Renderer renderer(executor, flat, camera, dynamic_settings({"ir", Algorithm::ir}, edge, 0));
    for (std::uint32_t i = 0; i < count; ++i) (void)renderer.render_frame({});
    return renderer.image();
}

nlohmann::json measure_static(Executor& executor, const FlatScene& flat, const Camera& camera,
                              const std::vector<DynamicMethod>& methods,
                              const StaticReferences& references, const StaticRun& run) {
    std::vector<StaticMethod> entrants;
    for (const DynamicMethod& method : methods)
        if (!method.full && !method.temporal()) entrants.push_back({method});
    // Other random numbers than the image by `ir` has, whose VPLs would be theirs as well.
    for (std::uint32_t repetition = 1; repetition <= run.repetitions; ++repetition)
        for (StaticMethod& entrant : entrants)
            measure(entrant, executor, flat, camera, references, run.edge, repetition);
    nlohmann::json rows = nlohmann::json::array();
    for (const StaticMethod& entrant : entrants) rows.push_back(row_of(entrant));
    return rows;
}

std::string static_heading() {
    return fmt::format("{:>14} {:>18} {:>9} {:>12} {:>10} {:>9} {:>10} {:>10} {:>9}\n", "scene",
                       "method", "ms", "rays", "relMSE", "+-", "trimmed", "to ir", "VDP 75 %");
}

std::string static_table(const nlohmann::json& scene) {
    const auto cell = [](const std::optional<double>& value, int width, int decimals) {
        return value ? fmt::format(" {:>{}.{}f}", *value, width, decimals)
                     : fmt::format(" {:>{}}", "-", width);
    };
    std::string lines;
    for (const nlohmann::json& row : scene["methods"])
        lines += fmt::format("{:>14} {:>18}", scene["scene"].get<std::string>(),
                             row["method"].get<std::string>()) +
                 cell(number_at(row, "/ms"), 9, 1) + cell(number_at(row, "/rays"), 12, 0) +
                 cell(number_at(row, "/relmse_path/mean"), 10, 5) +
                 cell(number_at(row, "/relmse_path/uncertainty"), 9, 5) +
                 cell(number_at(row, "/relmse_trimmed_path/mean"), 10, 5) +
                 cell(number_at(row, "/relmse_ir/mean"), 10, 5) +
                 cell(number_at(row, "/first_frame/hdrvdp_published/p75"), 9, 2) + "\n";
    return lines;
}

nlohmann::json static_summary(const nlohmann::json& scenes) {
    nlohmann::json summary = nlohmann::json::object();
    const std::map<std::string, std::string> others{{"igi", "igi"},
                                                    {"irradiance-cache", "irradiance_cache"}};
    for (const auto& [other, key] : others) {
        summary["ic_vs_" + key] = mean_ratio(scenes, other, "ic", "/ms");
        summary["relmse_ic_vs_" + key] = mean_ratio(scenes, "ic", other, "/relmse_path/mean");
        summary["relmse_trimmed_ic_vs_" + key] =
            mean_ratio(scenes, "ic", other, "/relmse_trimmed_path/mean");
        summary["relmse_ir_ic_vs_" + key] = mean_ratio(scenes, "ic", other, "/relmse_ir/mean");
    }
    return summary;
}

}  // namespace weft::bench
