// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/prediction_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "base/student_t.h"

namespace weft {

double median(std::span<const double> values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted.at(half) : 0.5 * (sorted.at(half - 1) + sorted.at(half));
}

Interval prediction_interval(std::span<const double> values, double coverage, IntervalScale scale) {
    if (values.size() < 2) throw std::invalid_argument("an interval needs two measurements");
    const bool logarithmic =
        scale == IntervalScale::logarithmic &&
        std::all_of(values.begin(), values.end(), [](double value) { return value > 0.0; });
    std::vector<double> samples(values.begin(), values.end());
    if (logarithmic)
        for (double& sample : samples) sample = std::log(sample);
    const auto count = static_cast<double>(samples.size());
    double mean = 0.0;
    for (const double sample : samples) mean += sample / count;
    double squares = 0.0;
    for (const double sample : samples) squares += (sample - mean) * (sample - mean);
    const double deviation = std::sqrt(squares / (count - 1.0));
    const auto degrees = static_cast<std::uint32_t>(samples.size() - 1);
    const double reach =
        student_t_quantile(coverage, degrees) * deviation * std::sqrt(1.0 + 1.0 / count);
    const Interval ends = logarithmic
                              ? Interval{0.0, std::exp(mean - reach), std::exp(mean + reach)}
                              : Interval{0.0, std::max(0.0, mean - reach), mean + reach};
    const double middle = median(values);
    // Rounding must not exclude the median, and no end may overflow.
    return {middle, std::min(ends.low, middle),
            std::min(std::max(ends.high, middle), std::numeric_limits<double>::max())};
}

}  // namespace weft
