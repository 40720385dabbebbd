// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/tables/tables_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/common/candidate.h"
#include "bench/tables/shipped_scenes.h"

namespace weft::bench {
namespace {

using Figure = std::function<double(const FrameTime&)>;

double wall(const FrameTime& time) {
    return time.wall_ms;
}
double processor(const FrameTime& time) {
    return time.cpu_ms;
}

/// A component's column and its time.
struct Column {
    const char* name;
    Figure ms;
};
std::array<Column, 4> columns() {
    return {{{"ID", [](const FrameTime& time) { return time.indirect.ms; }},
             {"SS", [](const FrameTime& time) { return time.direct.ms; }},
             {"PM", [](const FrameTime& time) { return time.media.ms; }},
             {"FULL", wall}}};
}

/// A method, and how columns of the tables name it.
struct Method {
    const char* name;
    const char* column;
};
constexpr std::array<Method, 4> methods{
    {{method_ais, "A"}, {method_amax, "AMAX"}, {method_igi, "IGI"}, {method_ic, "IC"}}};

/// With as many digits as a measurement can mean; null for what is no figure.
nlohmann::json significant(double value) {
    if (!std::isfinite(value)) return {};
    return std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr);
}
nlohmann::json significant(const std::vector<double>& values) {
    nlohmann::json list = nlohmann::json::array();
    for (const double value : values) list.push_back(significant(value));
    return list;
}
/// Null unless above 0: what was not measured.
nlohmann::json measured(double value) {
    return value > 0.0 ? significant(value) : nlohmann::json();
}
/// All figures within a value, likewise.
nlohmann::json rounded(const nlohmann::json& value) {
    if (value.is_number_float()) return significant(value.get<double>());
    nlohmann::json result = value;
    if (value.is_object())
        for (auto& entry : result.items()) entry.value() = rounded(entry.value());
    return result;
}

nlohmann::json runs_of(const MethodFrames& frames, const Figure& figure) {
    std::vector<double> values;
    for (const FrameTime& time : frames.of(FrameView::full)) values.push_back(figure(time));
    const bool any = std::any_of(values.begin(), values.end(), [](double ms) { return ms > 0.0; });
    return any ? significant(values) : nlohmann::json();
}

/// Medians of the stages of full frames.
nlohmann::json stages_json(const MethodFrames& frames) {
    nlohmann::json stages = nlohmann::json::object();
    if (frames.of(FrameView::full).empty()) return stages;
    for (const StageStats& stage : frames.of(FrameView::full).front().stages) {
        const std::string name = (stage.component.empty() ? "" : stage.component + ": ") +
                                 std::string(stage_name(stage.stage));
        stages[name] = significant(frames.median_of(FrameView::full, [&](const FrameTime& time) {
            return time.stage_ms(stage.component, stage.stage);
        }));
    }
    return stages;
}

nlohmann::json sampled_json(const MethodFrames& frames) {
    nlohmann::json sampled = nlohmann::json::object();
    const double pixels = static_cast<double>(frames.image.width) * frames.image.height;
    for (const char* const component : {"indirect", "direct", "media"})
        sampled[component] = measured(frames.median_of(FrameView::full, [&](const FrameTime& time) {
            return 100.0 * static_cast<double>(time.sampled(component)) / pixels;
        }));
    return sampled;
}

nlohmann::json method_json(const MethodFrames& frames, const MethodErrors* errors) {
    const auto median_ms = [&](FrameView view, const Figure& figure) {
        return measured(frames.median_of(view, figure));
    };
    nlohmann::json ms{{"cpu", median_ms(FrameView::full, processor)},
                      {"id_alone", median_ms(FrameView::indirect, wall)},
                      {"ss_alone", median_ms(FrameView::direct, wall)}};
    nlohmann::json runs;
    for (const Column& column : columns()) {
        ms[column.name] = median_ms(FrameView::full, column.ms);
        runs[column.name] = runs_of(frames, column.ms);
    }
    nlohmann::json json{
        {"ms", ms},
        {"runs_ms", runs},
        {"stages_ms", stages_json(frames)},
        {"sampled_percent", sampled_json(frames)},
        {"mrays", significant(frames.median_of(FrameView::full, [](const FrameTime& time) {
             return static_cast<double>(time.all.rays) * 1e-6;
         }))}};
    if (errors != nullptr) json["errors"] = rounded(errors->box.beauty.json());
    return json;
}

nlohmann::json moving_json(const MovingTimes& moving) {
    const auto times = [](const std::vector<double>& ms) {
        return nlohmann::json{{"ms", measured(median(ms))}, {"runs_ms", significant(ms)}};
    };
    return {{method_ic, times(moving.ic)},
            {method_tic, times(moving.tic)},
            {"update_ms", significant(median(moving.update))}};
}

/// How many times as fast the second is, frame by frame; the median.
double ratio_of(const std::vector<double>& slow, const std::vector<double>& fast) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(slow.size(), fast.size()); ++i)
        if (slow[i] > 0.0 && fast[i] > 0.0) ratios.push_back(slow[i] / fast[i]);
    return median(std::move(ratios));
}

nlohmann::json fps_row(const TableScene& scene) {
    nlohmann::json row;
    const auto per_second = [](double ms) { return ms > 0.0 ? measured(1e3 / ms) : measured(0.0); };
    for (const Method& method : methods) {
        const MethodFrames* const frames = scene.measured.frames.find(method.name);
        for (const Column& column : columns())
            row[std::string(column.name) + "_" + method.column] =
                per_second(frames != nullptr ? frames->median_of(FrameView::full, column.ms) : 0.0);
    }
    row["FULL_TIC"] = per_second(scene.moving ? median(scene.moving->tic) : 0.0);
    return row;
}

nlohmann::json speedup_row(const TableScene& scene) {
    const auto over = [&](const char* other, FrameView view, const Figure& figure) {
        const MethodFrames* const ours = scene.measured.frames.find(method_ais);
        const MethodFrames* const theirs = scene.measured.frames.find(other);
        const bool both = ours != nullptr && theirs != nullptr;
        return measured(both ? frame_ratio(*ours, *theirs, view, figure) : 0.0);
    };
    nlohmann::json row;
    for (const Column& column : columns())
        row[column.name] = over(method_amax, FrameView::full, column.ms);
    row["FULL_A_vs_IGI"] = over(method_igi, FrameView::full, wall);
    row["FULL_A_vs_IC"] = over(method_ic, FrameView::full, wall);
    row["ID_alone"] = over(method_amax, FrameView::indirect, wall);
    row["SS_alone"] = over(method_amax, FrameView::direct, wall);
    row["FULL_cpu"] = over(method_amax, FrameView::full, processor);
    row["FULL_A_vs_IGI_cpu"] = over(method_igi, FrameView::full, processor);
    row["TIC_vs_IC"] = measured(scene.moving ? ratio_of(scene.moving->ic, scene.moving->tic) : 0.0);
    return row;
}

/// A row of each table of errors, those of the eye with the floor of the reference.
void add_error_rows(const AdaptiveScene& scene, nlohmann::json& rows) {
    const auto add = [&](const char* table, const std::string& column, const auto& value) {
        rows[table][column] = value ? significant(*value) : nlohmann::json();
    };
    const auto add_shares = [&](const char* table, const std::string& column,
                                const std::optional<VisibleShares>& shares) {
        add(table, column + "_75", shares ? std::optional(shares->p75) : std::nullopt);
        add(table, column + "_95", shares ? std::optional(shares->p95) : std::nullopt);
    };
    for (const Method& method : methods) {
        const MethodErrors* const of_method = scene.errors_of(method.name);
        const ImageErrors errors = of_method != nullptr ? of_method->box.beauty : ImageErrors{};
        const std::string column = method.column;
        add_shares("hdrvdp_percent_of_pixels", column, errors.published);
        add_shares("hdrvdp_display", column, errors.display);
        add("hdrflip", column, errors.hdrflip);
        add("relmse", column, errors.relmse);
        add("bias", column, errors.bias);
        const auto& unbiased = errors.unbiased_relmse;
        const auto add_unbiased = [&](const char* table, double ErrorEstimate::*member) {
            add(table, column, unbiased ? std::optional((*unbiased).*member) : std::nullopt);
        };
        add_unbiased("unbiased_relmse", &ErrorEstimate::value);
        add_unbiased("unbiased_relmse_low", &ErrorEstimate::low);
        add_unbiased("unbiased_relmse_high", &ErrorEstimate::high);
    }
    if (!scene.floors.box) return;
    const ImageErrors& floor = *scene.floors.box;
    add_shares("hdrvdp_percent_of_pixels", "floor", floor.published);
    add_shares("hdrvdp_display", "floor", floor.display);
    add("hdrflip", "floor", floor.hdrflip);
    add("relmse", "noise", scene.floors.box_noise);
}

}  // namespace

nlohmann::json table_scene_json(const TableScene& scene) {
    const AdaptiveScene& measured_scene = scene.measured;
    const std::string published = published_scene(measured_scene.name);
    const nlohmann::json& references = measured_scene.references;
    const nlohmann::json reference =
        references.contains("box") ? references["box"] : nlohmann::json();
    nlohmann::json by_method = nlohmann::json::object();
    for (const MethodFrames& frames : measured_scene.frames.methods)
        by_method[frames.name] = method_json(frames, measured_scene.errors_of(frames.name));
    nlohmann::json rows{{"fps", fps_row(scene)}, {"speedup", speedup_row(scene)}};
    if (!measured_scene.errors.empty()) add_error_rows(measured_scene, rows);
    return {
        {"scene", measured_scene.name},
        {"set", measured_scene.shipped ? "shipped" : "real"},
        {"published", published.empty() ? nlohmann::json() : nlohmann::json(published)},
        {"triangles", measured_scene.triangles},
        {"media", measured_scene.media},
        {"reference", reference},
        {"methods", by_method},
        {"moving", scene.moving ? moving_json(*scene.moving) : nlohmann::json()},
        {"rows", rows},
    };
}

}  // namespace weft::bench
