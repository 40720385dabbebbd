// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_TIME_SPREAD_H
#define WEFT_TRADEOFF_TIME_SPREAD_H

#include <span>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// How far one more time of a setting may lie from the median of those that it has. It is estimated
/// from the times (runs_ms) of all settings, as many of each and in the same rounds: a few times of
/// one setting say little about its next, and what disturbs one setting may disturb any. Each time
/// is compared with the others of its setting, so that differences between seeds and between rounds
/// are included. The reach is the larger of
/// - Student's, by the root mean square of these deviations, which are cut off at the second reach,
///   and their degrees of freedom where whole rounds may differ (Satterthwaite 1946),
/// - the quantile `coverage` of their magnitudes, by rank, where there are enough of them.
/// A setting that has a time of 0 has no ratios, and is left out. No settings give no deviations.
/// Throws std::invalid_argument where a setting has fewer than two times or not as many as another,
/// or one that is negative or not finite.
[[nodiscard]] TimeSpread time_spread(std::span<const TradeoffPoint> points, double coverage = 0.95);

/// The interval in which one more time of a setting lies, after these ones: its median divided and
/// multiplied by the factor of the spread. Where one of the times is 0, or two lie outside of that
/// interval, so that the setting scatters more than others, it is the prediction_interval of these
/// times alone. No end overflows. Throws std::invalid_argument as time_spread.
[[nodiscard]] Interval time_interval(std::span<const double> times, const TimeSpread& spread,
                                     double coverage = 0.95);

}  // namespace weft

#endif
