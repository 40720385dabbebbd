// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_ADVICE_H
#define WEFT_TRADEOFF_ADVICE_H

#include <span>
#include <string>
#include <vector>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// What the upper end of an interval may be, in budgets.
inline constexpr double most_over_budget = 1.2;

/// The point of least error whose time keeps to a budget in milliseconds: its median is at most
/// that, and the upper end of its interval at most a fifth more. A name for people is in the
/// sentence; where no point keeps to it, the sentence says which is the fastest, and where there
/// is no point at all, that. Points of times or errors that are not finite count as not there.
[[nodiscard]] TradeoffAdvice advice_for_budget(std::span<const TradeoffPoint> points,
                                               ErrorMeasure measure, double budget_ms);

/// The fastest point whose median error is at most that, above 0; the same of points that are none.
[[nodiscard]] TradeoffAdvice advice_for_error(std::span<const TradeoffPoint> points,
                                              ErrorMeasure measure, double error);

/// Up to three errors, of two digits and apart, that divide the range of the front's evenly on a
/// logarithmic scale; none where it has no range.
[[nodiscard]] std::vector<double> sensible_errors(std::span<const TradeoffPoint> points,
                                                  ErrorMeasure measure);

/// The file of settings for an answer: "preset-300ms.json", "preset-2.5s.json".
[[nodiscard]] std::string preset_file_for_budget(double budget_ms);
/// "preset-error-0.05.json".
[[nodiscard]] std::string preset_file_for_error(double error);

/// "300 ms", "2.5 s".
[[nodiscard]] std::string time_text(double ms);

}  // namespace weft

#endif
