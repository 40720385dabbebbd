// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "tradeoff/advice.h"
#include "tradeoff/html_text.h"

namespace weft {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool in_percent(ErrorMeasure measure) {
    return measure == ErrorMeasure::vdp75 || measure == ErrorMeasure::vdp95 ||
           measure == ErrorMeasure::vdp75_display || measure == ErrorMeasure::vdp95_display;
}

bool has_range(const Interval& interval) {
    return std::isfinite(interval.low) && std::isfinite(interval.high) &&
           interval.low != interval.high;
}

/// "low to high", without a unit.
std::string ends_text(double low, double high) {
    return figure_text(low) + " to " + figure_text(high);
}

/// Seconds where the median is written in seconds.
std::string time_ends(const Interval& ms) {
    const double scale = ms.median >= 1000.0 ? 1e-3 : 1.0;
    return ends_text(scale * ms.low, scale * ms.high);
}

std::string cell(const std::string& value, bool range, const std::string& ends) {
    return value + (range ? "<small>" + ends + "</small>" : "");
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

Interval error_of(const TradeoffPoint& point, ErrorMeasure measure) {
    const auto index = static_cast<std::size_t>(measure);
    return index < point.errors.size() ? point.errors[index] : Interval{none, none, none};
}

double error_of(std::span<const double> errors, ErrorMeasure measure) {
    const auto index = static_cast<std::size_t>(measure);
    return index < errors.size() ? errors[index] : none;
}

std::vector<const TradeoffPoint*> front_of(const TradeoffResult& result) {
    std::vector<const TradeoffPoint*> front;
    for (const TradeoffPoint& point : result.points)
        if (point.on_front) front.push_back(&point);
    return front;
}

const TradeoffPoint* best_within(const TradeoffResult& result, double ms) {
    const TradeoffPoint* best = nullptr;
    for (const TradeoffPoint* point : front_of(result)) {
        const double error = error_of(*point, result.measure).median;
        if (!(point->ms.median <= ms) || !(point->ms.high <= most_over_budget * ms)) continue;
        if (!std::isfinite(error)) continue;
        if (best == nullptr || error < error_of(*best, result.measure).median) best = point;
    }
    return best;
}

std::string duration_text(double ms) {
    if (!std::isfinite(ms)) return figure_text(ms);
    return ms >= 1000.0 ? figure_text(1e-3 * ms) + " s" : figure_text(ms) + " ms";
}

std::string error_figure(ErrorMeasure measure, double value) {
    const bool percent = in_percent(measure) && std::isfinite(value);
    return figure_text(value) + (percent ? " %" : "");
}

std::string time_range_text(const Interval& ms) {
    return duration_text(ms.median) + (has_range(ms) ? " (" + time_ends(ms) + ")" : "");
}

std::string error_range_text(ErrorMeasure measure, const Interval& error) {
    return error_figure(measure, error.median) +
           (has_range(error) ? " (" + ends_text(error.low, error.high) + ")" : "");
}

std::string time_cell(const Interval& ms) {
    return cell(duration_text(ms.median), has_range(ms), time_ends(ms));
}

std::string error_cell(ErrorMeasure measure, const Interval& error) {
    return cell(error_figure(measure, error.median), has_range(error),
                ends_text(error.low, error.high));
}

}  // namespace weft
