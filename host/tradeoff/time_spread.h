// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_TIME_SPREAD_H
#define WEFT_TRADEOFF_TIME_SPREAD_H

#include <span>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// How far one more time of a setting lies from the median of those it has, by the times of all
/// settings, runs_ms, as many of each and in the same rounds. How steady a few times of one setting
/// are says little of its next: what disturbs one disturbs any. Each time is compared with the
/// others of its setting, so that what differs between seeds and between rounds is in it. The reach
/// is the larger of
/// - Student's, by the root mean square of these deviations and the degrees of freedom that are
///   left where whole rounds may differ (Satterthwaite 1946): what lies far out is taken as no
///   farther than the second,
/// - the share `coverage` of their magnitudes, by rank, where there are enough of them.
/// A setting that has a time of 0 has no ratios, and is left out. No settings give no deviations.
/// Throws std::invalid_argument where a setting has fewer than two times or not as many as another,
/// or one that is negative or not finite.
[[nodiscard]] TimeSpread time_spread(std::span<const TradeoffPoint> points, double coverage = 0.95);

/// Where one more time of a setting lies, after these ones: its median divided and multiplied by
/// the factor of the spread. Where one is 0, or two lie beyond that themselves, so that the setting
/// scatters more than others, its prediction_interval alone. No end overflows. Throws
/// std::invalid_argument as time_spread.
[[nodiscard]] Interval time_interval(std::span<const double> times, const TimeSpread& spread,
                                     double coverage = 0.95);

}  // namespace weft

#endif
