// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page_values.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "tradeoff/html_text.h"

namespace weft {
namespace {

bool in_percent(ErrorMeasure measure) {
    return measure == ErrorMeasure::vdp75 || measure == ErrorMeasure::vdp95 ||
           measure == ErrorMeasure::vdp75_display || measure == ErrorMeasure::vdp95_display;
}

std::string range_text(const Interval& interval, double scale) {
    if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return {};
    if (interval.low == interval.high) return {};
    return figure_text(scale * interval.low) + " to " + figure_text(scale * interval.high);
}

nlohmann::json error_cell(ErrorMeasure measure, const Interval& error, ErrorMeasure chosen) {
    return {{"error", error_figure(measure, error.median)},
            {"range", error_range(error)},
            {"chosen", measure == chosen}};
}

nlohmann::json unbiased_cell(const std::optional<ErrorEstimate>& unbiased) {
    if (!unbiased) return {{"error", ""}, {"range", ""}, {"chosen", false}};
    return {{"error", figure_text(unbiased->value)},
            {"range", error_range({unbiased->value, unbiased->low, unbiased->high})},
            {"chosen", false}};
}

}  // namespace

std::array<ErrorMeasure, error_measures> all_measures() {
    std::array<ErrorMeasure, error_measures> measures{};
    for (std::size_t i = 0; i < error_measures; ++i) measures[i] = static_cast<ErrorMeasure>(i);
    return measures;
}

const char* unit_of(ErrorMeasure measure) {
    return in_percent(measure) ? "% of pixels" : "";
}

std::vector<const TradeoffPoint*> front_of(const TradeoffResult& result) {
    std::vector<const TradeoffPoint*> front;
    for (const TradeoffPoint& point : result.points)
        if (point.on_front) front.push_back(&point);
    return front;
}

std::string duration_text(double ms) {
    if (!std::isfinite(ms)) return figure_text(ms);
    return ms >= 1000.0 ? figure_text(1e-3 * ms) + " s" : figure_text(ms) + " ms";
}

std::string error_figure(ErrorMeasure measure, double value) {
    const bool percent = in_percent(measure) && std::isfinite(value);
    return figure_text(value) + (percent ? " %" : "");
}

std::string time_range(const Interval& ms) {
    return range_text(ms, ms.median >= 1000.0 ? 1e-3 : 1.0);
}

std::string error_range(const Interval& error) {
    return range_text(error, 1.0);
}

nlohmann::json error_cells(const TradeoffPoint& point, ErrorMeasure chosen) {
    auto cells = nlohmann::json::array();
    for (const ErrorMeasure measure : all_measures())
        cells.push_back(error_cell(measure, error_of(point, measure), chosen));
    cells.push_back(unbiased_cell(point.unbiased_relmse));
    return cells;
}

nlohmann::json error_cells(std::span<const double> errors, ErrorMeasure chosen,
                           const std::optional<ErrorEstimate>& unbiased) {
    auto cells = nlohmann::json::array();
    for (const ErrorMeasure measure : all_measures()) {
        const double error = error_of(errors, measure);
        cells.push_back(error_cell(measure, {error, error, error}, chosen));
    }
    cells.push_back(unbiased_cell(unbiased));
    return cells;
}

nlohmann::json unless_empty(nlohmann::json list) {
    if (list.empty()) return false;
    return {{"all", std::move(list)}};
}

}  // namespace weft
