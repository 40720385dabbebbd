// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/shell_word.h"
#include "tradeoff/fill_template.h"
#include "tradeoff/html_text.h"
#include "tradeoff/noise_floor.h"
#include "tradeoff/page_images.h"
#include "tradeoff/page_values.h"
#include "tradeoff/svg_plot.h"

namespace weft {
namespace {

using Json = nlohmann::json;

constexpr std::string_view page_template =
#include "tradeoff_page.html.inc"
    ;

Json answer_values(const TradeoffResult& result) {
    auto answers = Json::array();
    for (const TradeoffAdvice& advice : result.advice) {
        const auto preset = std::filesystem::path(result.folder) / advice.preset_file;
        const std::string command =
            fmt::format("weft render {} --preset {}{} -o out.exr", shell_file(result.scene_path),
                        shell_file(preset.string()), result.image_options);
        answers.push_back({{"sentence", advice.sentence},
                           {"render_command", advice.preset_file.empty() ? "" : command}});
    }
    return unless_empty(std::move(answers));
}

std::string in_brackets(const std::string& range) {
    return range.empty() ? "" : " (" + range + ")";
}

PlotPoint plot_point(const TradeoffPoint& point, ErrorMeasure measure) {
    const Interval error = error_of(point, measure);
    return {.x = point.ms.median,
            .y = error.median,
            .x_bar = PlotBar{point.ms.low, point.ms.high},
            .y_bar = PlotBar{error.low, error.high},
            .tooltip =
                fmt::format("{}: {}{}, {} {}{}", point.name, duration_text(point.ms.median),
                            in_brackets(time_range(point.ms)), label(measure),
                            error_figure(measure, error.median), in_brackets(error_range(error))),
            .marked = point.on_front};
}

PlotPoint plot_point(const OtherRendererPoint& other, ErrorMeasure measure) {
    const double ms = 1000.0 * other.seconds;
    const double error = error_of(other.errors, measure);
    return {
        .x = ms,
        .y = error,
        .tooltip = fmt::format("{}: {}, {} {}{}", other.name, duration_text(ms), label(measure),
                               error_figure(measure, error), other.denoised ? ", denoised" : "")};
}

PlotSeries front_line(const TradeoffResult& result) {
    PlotSeries line;
    line.name = "front";
    line.line = true;
    line.markers = false;
    line.neutral = true;
    for (const TradeoffPoint* point : front_of(result))
        line.points.push_back(
            {.x = point->ms.median, .y = error_of(*point, result.measure).median});
    return line;
}

/// All series, with styles by name, so that a family looks the same in the plots of several pages.
std::vector<PlotSeries> all_series(const TradeoffResult& result, ErrorMeasure measure) {
    std::map<std::string, std::vector<PlotPoint>> families;
    for (const TradeoffPoint& point : result.points)
        families[point.family].push_back(plot_point(point, measure));
    std::map<std::string, std::vector<PlotPoint>> others;
    for (const OtherRendererPoint& other : result.others)
        others[other.name].push_back(plot_point(other, measure));
    std::vector<PlotSeries> series;
    const auto take = [&series](std::map<std::string, std::vector<PlotPoint>>& groups,
                                bool hollow) {
        for (auto& [name, points] : groups)
            series.push_back({.name = name,
                              .style = series.size(),
                              .points = std::move(points),
                              .hollow = hollow});
    };
    take(families, false);
    take(others, true);
    return series;
}

/// Error over time by a measure, both logarithmic: a series for each family of settings and for
/// each other renderer, points of the front ringed, the noise floor of the reference as a level.
/// In the plot of the measure that defines the front, a line joins the front.
Plot tradeoff_plot(const TradeoffResult& result, ErrorMeasure measure) {
    Plot plot;
    plot.title = fmt::format("{} over time", label(measure));
    plot.description = "All values are in the tables of this page.";
    plot.x = {.label = "time of an image", .unit = "ms"};
    plot.y = {.label = label(measure), .unit = unit_of(measure)};
    plot.series = all_series(result, measure);
    if (measure == result.measure) plot.series.insert(plot.series.begin(), front_line(result));
    const double floor = error_of(result.reference.noise_floor, measure);
    plot.levels.push_back({"half of the reference against half", floor});
    plot.marked = "on the front";
    return plot;
}

/// The plots of all measures but the chosen one, which has a larger plot.
Json small_plots(const TradeoffResult& result) {
    auto plots = Json::array();
    for (const ErrorMeasure measure : all_measures()) {
        if (measure == result.measure) continue;
        Plot plot = tradeoff_plot(result, measure);
        plot.width = 430.0;
        plot.height = 310.0;
        plot.legend = false;
        plots.push_back(svg_plot(plot));
    }
    return plots;
}

/// A label whose percent sign stays with its number.
std::string unbroken(std::string text) {
    const std::size_t space = text.find(" %");
    return space == std::string::npos ? text : text.replace(space, 1, "\u00A0");
}

Json heading_values(ErrorMeasure chosen) {
    auto headings = Json::array();
    for (const ErrorMeasure measure : all_measures())
        headings.push_back({{"label", unbroken(label(measure))}, {"chosen", measure == chosen}});
    headings.push_back({{"label", "unbiased relMSE"}, {"chosen", false}});
    return headings;
}

Json point_values(const TradeoffPoint& point, ErrorMeasure chosen) {
    return {{"name", point.name},
            {"family", point.family},
            {"on_front", point.on_front},
            {"time", duration_text(point.ms.median)},
            {"time_range", time_range(point.ms)},
            {"errors", error_cells(point, chosen)},
            {"rays", short_count_text(point.rays)}};
}

/// Names and values in one line each; objects within objects stay JSON.
Json machine_values(const Json& machine) {
    auto facts = Json::array();
    const auto add = [&facts](const std::string& name, const Json& value) {
        facts.push_back(
            {{"name", name},
             {"value", value.is_string()
                           ? value.get<std::string>()
                           : value.dump(-1, ' ', false, Json::error_handler_t::replace)}});
    };
    if (!machine.is_object()) return false;
    for (const auto& [name, value] : machine.items()) {
        if (!value.is_object())
            add(name, value);
        else
            for (const auto& [part, inner] : value.items()) add(name + " " + part, inner);
    }
    return unless_empty(std::move(facts));
}

Json check_values(const std::optional<FrontCheck>& check) {
    if (!check) return false;
    return {{"images", std::to_string(check->images)},
            {"times", std::to_string(check->times_within)},
            {"errors", std::to_string(check->errors_within)}};
}

Json spread_values(const TimeSpread& spread) {
    if (spread.deviations == 0) return false;
    return {{"factor", figure_text(spread.factor)}, {"deviations", count_text(spread.deviations)}};
}

}  // namespace

std::string tradeoff_page(const TradeoffResult& result) {
    std::set<std::string_view> families;
    auto points = Json::array();
    auto front = Json::array();
    for (const TradeoffPoint& point : result.points) {
        families.insert(point.family);
        points.push_back(point_values(point, result.measure));
        if (point.on_front) front.push_back(points.back());
    }
    const Json images = images_values(result);
    const Json values = {
        {"plot_style", plot_style()},
        {"scene", result.scene},
        {"width", std::to_string(result.width)},
        {"height", std::to_string(result.height)},
        {"settings", count_text(result.points.size())},
        {"families", std::to_string(families.size())},
        {"repetitions", std::to_string(result.repetitions)},
        {"reference_samples", count_text(result.reference.samples)},
        {"measure", label(result.measure)},
        {"answers", answer_values(result)},
        {"plot", svg_plot(tradeoff_plot(result, result.measure))},
        {"small_plots", small_plots(result)},
        {"headings", heading_values(result.measure)},
        {"front", std::move(front)},
        {"noise_floor", error_cells(result.reference.noise_floor, result.measure, {})},
        {"floor_sentence", floor_sentence(result)},
        {"noisy_reference", result.reference.noise_relmse.value_or(0.0) > most_noise_relmse},
        {"check", check_values(result.check)},
        {"images", images},
        {"equal_time", equal_time_values(result, images)},
        {"points", std::move(points)},
        {"skipped", fmt::format("{}", fmt::join(result.skipped, ", "))},
        {"time_spread", spread_values(result.time_spread)},
        {"machine", machine_values(result.machine)},
        {"command", result.command},
    };
    return fill_template(page_template, values);
}

}  // namespace weft
