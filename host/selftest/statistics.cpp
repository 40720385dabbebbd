// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::selftest {
namespace {

/// Where a falling function on [0, high] has the value `value`.
template <class Falling>
double where_falls_to(double value, double high, const Falling& function) {
    double low = 0.0;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (function(middle) > value ? low : high) = middle;
    }
    return high;
}

/// Probability of failure of each of `comparisons` that together fail with probability `failure`.
double share_of(double failure, std::size_t comparisons) {
    return -std::expm1(std::log1p(-failure) / static_cast<double>(comparisons));
}

}  // namespace

Estimate estimate(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    Estimate result;
    for (const double value : values) result.mean += value / n;
    double square = 0.0;
    for (const double value : values) square += (value - result.mean) * (value - result.mean);
    result.error = std::sqrt(square / (n * (n - 1.0)));
    return result;
}

double sidak_limit(std::size_t comparisons, double failure) {
    return where_falls_to(share_of(failure, comparisons), 40.0,
                          [](double z) { return std::erfc(z / std::sqrt(2.0)); });
}

double student_tail(double t, double freedom) {
    // With t = sqrt(n) tan a, T has the pdf cos^(n - 1) a over angles: Simpson's rule.
    constexpr int steps = 4000;
    const auto integral = [&](double from) {
        const double h = (std::numbers::pi / 2.0 - from) / steps;
        double sum = 0.0;
        for (int i = 0; i <= steps; ++i) {
            const double weight = i == 0 || i == steps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
            sum += weight * std::pow(std::max(0.0, std::cos(from + i * h)), freedom - 1.0);
        }
        return sum * h / 3.0;
    };
    return integral(std::atan(t / std::sqrt(freedom))) / integral(0.0);
}

double student_limit(std::size_t values, std::size_t comparisons, double failure) {
    const double freedom = static_cast<double>(values) - 1.0;
    return where_falls_to(share_of(failure, comparisons), 100.0,
                          [&](double t) { return student_tail(t, freedom); });
}

}  // namespace weft::selftest
