// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_ADVICE_H
#define WEFT_TRADEOFF_ADVICE_H

#include <span>
#include <string>
#include <vector>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// Largest upper end of a time interval that keeps to a budget, as a factor on the budget.
inline constexpr double most_over_budget = 1.2;

/// The point of least error whose time keeps to a budget in milliseconds: its median is at most
/// that, and the upper end of its interval at most a fifth more. The sentence names the point;
/// where none keeps to the budget it names the fastest, and where there is no point at all it says
/// so. Points whose time or error is not finite are ignored.
[[nodiscard]] TradeoffAdvice advice_for_budget(std::span<const TradeoffPoint> points,
                                               ErrorMeasure measure, double budget_ms);

/// The fastest point whose median error is at most `error`, which is above 0; otherwise as
/// advice_for_budget.
[[nodiscard]] TradeoffAdvice advice_for_error(std::span<const TradeoffPoint> points,
                                              ErrorMeasure measure, double error);

/// Adds to the sentence that the reference's own noise hides what better settings would gain, where
/// the chosen point's error is less than twice `noise_floor` (one half of the reference's samples
/// against the other).
void add_noise_note(TradeoffAdvice& advice, std::span<const TradeoffPoint> points,
                    ErrorMeasure measure, double noise_floor);

/// Up to three errors to give advice for: distinct numbers of two digits that divide the range of
/// the front's errors evenly on a logarithmic scale; none where the front has no range.
[[nodiscard]] std::vector<double> sensible_errors(std::span<const TradeoffPoint> points,
                                                  ErrorMeasure measure);

/// Name of the preset for a budget, such as "preset-300ms.json" or "preset-2.5s.json".
[[nodiscard]] std::string preset_file_for_budget(double budget_ms);
/// Name of the preset for an error, such as "preset-error-0.05.json".
[[nodiscard]] std::string preset_file_for_error(double error);

/// A time with its unit, such as "300 ms" or "2.5 s".
[[nodiscard]] std::string time_text(double ms);

}  // namespace weft

#endif
