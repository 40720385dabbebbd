// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PREDICTION_INTERVAL_H
#define WEFT_TRADEOFF_PREDICTION_INTERVAL_H

#include <cstdint>
#include <span>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// The middle value of at least one, or the mean of the two in the middle.
[[nodiscard]] double median(std::span<const double> values);

/// The scale on which measurements are taken as normal: logarithmic for values of one sign, linear
/// for values whose sign is random, such as the magnitude of a bias.
enum class IntervalScale : std::uint8_t { logarithmic, linear };

/// The interval in which one further measurement lies with a confidence of `coverage`, after these
/// independent ones, at least two, none negative: mean +- t s sqrt(1 + 1/n) of their logarithms.
/// Where one of them is 0, and on a linear scale, it is that of the values themselves, cut off at
/// 0.
[[nodiscard]] Interval prediction_interval(std::span<const double> values, double coverage = 0.95,
                                           IntervalScale scale = IntervalScale::logarithmic);

}  // namespace weft

#endif
