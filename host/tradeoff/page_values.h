// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_VALUES_H
#define WEFT_TRADEOFF_PAGE_VALUES_H

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// All measures, in the order of the enumeration.
[[nodiscard]] std::array<ErrorMeasure, error_measures> all_measures();

/// Unit of a measure, for the axis of a plot; empty for plain numbers.
[[nodiscard]] const char* unit_of(ErrorMeasure measure);

/// The error of a point by that measure; its numbers are not finite where there is none.
[[nodiscard]] Interval error_of(const TradeoffPoint& point, ErrorMeasure measure);

/// The error by that measure in a list by ErrorMeasure; not finite where there is none.
[[nodiscard]] double error_of(std::span<const double> errors, ErrorMeasure measure);

/// The points of the front by rising time.
[[nodiscard]] std::vector<const TradeoffPoint*> front_of(const TradeoffResult& result);

/// The point of the front with the lowest error by the chosen measure among those whose median
/// time is at most `ms`, and the end of its interval at most most_over_budget times that; nullptr
/// where there is none.
[[nodiscard]] const TradeoffPoint* best_within(const TradeoffResult& result, double ms);

/// Milliseconds with their unit, seconds from 1000 on.
[[nodiscard]] std::string duration_text(double ms);

/// An error as text, with a percent sign where the measure counts percent.
[[nodiscard]] std::string error_figure(ErrorMeasure measure, double value);

/// Median and interval in words, plain text.
[[nodiscard]] std::string time_range_text(const Interval& ms);
[[nodiscard]] std::string error_range_text(ErrorMeasure measure, const Interval& error);

/// The same as markup for a cell of a table, the interval in a line of its own.
[[nodiscard]] std::string time_cell(const Interval& ms);
[[nodiscard]] std::string error_cell(ErrorMeasure measure, const Interval& error);

}  // namespace weft

#endif
