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
/// sentence; where no point keeps to it, the sentence says which is the fastest. `points` holds one
/// at least.
[[nodiscard]] TradeoffAdvice advice_for_budget(std::span<const TradeoffPoint> points,
                                               ErrorMeasure measure, double budget_ms);

/// The fastest point whose median error is at most that, above 0.
[[nodiscard]] TradeoffAdvice advice_for_error(std::span<const TradeoffPoint> points,
                                              ErrorMeasure measure, double error);

/// Up to three errors, of two digits and apart, that divide the range of the front's evenly on a
/// logarithmic scale; none where it has no range.
[[nodiscard]] std::vector<double> sensible_errors(std::span<const TradeoffPoint> points,
                                                  ErrorMeasure measure);

/// "300 ms", "2.5 s".
[[nodiscard]] std::string time_text(double ms);

}  // namespace weft

#endif
