// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/ratio.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bench/common/candidate.h"

namespace weft::bench {
namespace {

/// Of a normal distribution: standard deviation over median absolute deviation, and standard error
/// of the median over that of the mean.
constexpr double deviation_of_median = 1.4826;
constexpr double median_efficiency = 1.2533;

}  // namespace

Ratio operator*(const Ratio& a, const Ratio& b) {
    return {a.value * b.value, std::hypot(a.spread, b.spread)};
}

Ratio operator/(const Ratio& a, const Ratio& b) {
    return {a.value / b.value, std::hypot(a.spread, b.spread)};
}

Ratio geometric_mean(const std::vector<Ratio>& ratios) {
    if (ratios.empty()) return {};
    double sum = 0.0;
    double variance = 0.0;
    for (const Ratio& ratio : ratios) {
        sum += std::log(ratio.value);
        variance += ratio.spread * ratio.spread;
    }
    const auto count = static_cast<double>(ratios.size());
    return {std::exp(sum / count), std::sqrt(variance) / count};
}

Ratio jackknife(double value, const std::vector<double>& without) {
    const auto count = static_cast<double>(without.size());
    double mean = 0.0;
    for (const double one : without) mean += std::log(one) / count;
    double squares = 0.0;
    for (const double one : without) squares += std::pow(std::log(one) - mean, 2.0);
    return {value, std::sqrt(squares * (count - 1.0) / count)};
}

Ratio paired_ratio(const std::vector<double>& above, const std::vector<double>& below) {
    std::vector<double> logarithms;
    for (std::size_t i = 0; i < std::min(above.size(), below.size()); ++i)
        if (above[i] > 0.0 && below[i] > 0.0) logarithms.push_back(std::log(above[i] / below[i]));
    if (logarithms.empty()) return {};
    const double middle = median(logarithms);
    std::vector<double> deviations;
    deviations.reserve(logarithms.size());
    for (const double one : logarithms) deviations.push_back(std::abs(one - middle));
    const double error = deviation_of_median * median(deviations) * median_efficiency /
                         std::sqrt(static_cast<double>(logarithms.size()));
    return {std::exp(middle), error};
}

}  // namespace weft::bench
