// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_VALUES_H
#define WEFT_TRADEOFF_PAGE_VALUES_H

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// All measures, in the order of the enumeration.
[[nodiscard]] std::array<ErrorMeasure, error_measures> all_measures();

/// Unit of a measure, for the axis of a plot; empty for plain numbers.
[[nodiscard]] const char* unit_of(ErrorMeasure measure);

/// The points of the front by rising time.
[[nodiscard]] std::vector<const TradeoffPoint*> front_of(const TradeoffResult& result);

/// Milliseconds with their unit, seconds from 1000 on.
[[nodiscard]] std::string duration_text(double ms);

/// An error as text, with a percent sign where the measure counts percent.
[[nodiscard]] std::string error_figure(ErrorMeasure measure, double value);

/// "low to high" of an interval, a time in the unit of its duration_text; empty where an end is not
/// finite or both are the same.
[[nodiscard]] std::string time_range(const Interval& ms);
[[nodiscard]] std::string error_range(const Interval& error);

/// Cells of a table's row, one for each measure and one for the unbiased relMSE: `error`, `range`,
/// and whether it is the `chosen`. Without an estimate the last is empty.
[[nodiscard]] nlohmann::json error_cells(const TradeoffPoint& point, ErrorMeasure chosen);
[[nodiscard]] nlohmann::json error_cells(std::span<const double> errors, ErrorMeasure chosen,
                                         const std::optional<ErrorEstimate>& unbiased);

/// A list for a part of a template that is left out where the list is empty: `all` within it.
[[nodiscard]] nlohmann::json unless_empty(nlohmann::json list);

}  // namespace weft

#endif
