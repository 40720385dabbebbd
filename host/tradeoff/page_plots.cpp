// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page_plots.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "tradeoff/html_text.h"
#include "tradeoff/page_values.h"

namespace weft {
namespace {

PlotPoint plot_point(const TradeoffPoint& point, ErrorMeasure measure) {
    const Interval error = error_of(point, measure);
    return {.x = point.ms.median,
            .y = error.median,
            .x_bar = PlotBar{point.ms.low, point.ms.high},
            .y_bar = PlotBar{error.low, error.high},
            .tooltip = fmt::format("{}: {}, {} {}", point.name, time_range_text(point.ms),
                                   label(measure), error_range_text(measure, error)),
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

}  // namespace

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

std::string plots_section(const TradeoffResult& result) {
    std::string text = "<section>\n<h2>Error over time</h2>\n";
    text += fmt::format(
        "<p>Left is faster, below is nearer to the reference. A point is the median of its "
        "repetitions, bars are where one more will lie with a confidence of 95 %. Ringed points "
        "are those of the front by {}: no other setting is both faster and nearer. Hollow points "
        "are other renderers. The dashed line is one half of the reference's samples against the "
        "other: twice the noise of the whole, and in relMSE four times. Errors of the size that "
        "this leaves say nothing.</p>\n",
        escape_markup(label(result.measure)));
    text += "<figure>\n" + svg_plot(tradeoff_plot(result, result.measure)) + "</figure>\n";
    text += "<h3>By the other measures</h3>\n<div class=\"small-plots\">\n";
    for (const ErrorMeasure measure : all_measures()) {
        if (measure == result.measure) continue;
        Plot plot = tradeoff_plot(result, measure);
        plot.width = 430.0;
        plot.height = 310.0;
        plot.legend = false;
        text += "<figure>\n" + svg_plot(plot) + "</figure>\n";
    }
    return text + "</div>\n</section>\n";
}

}  // namespace weft
