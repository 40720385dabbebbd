// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/welch_test.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/student_t.h"

namespace weft {
namespace {

constexpr double coverage = 0.995;
// Of the normal distribution, Student's with infinitely many degrees of freedom.
constexpr double normal_squared = 7.879438576622417;
// Squared quantiles are all but linear in the inverse degrees beyond the last that is tabulated.
constexpr std::uint32_t tabulated_degrees = 64;

double squared_quantile(std::uint32_t degrees) {
    const double quantile = student_t_quantile(coverage, degrees);
    return quantile * quantile;
}

}  // namespace

StudentLimits::StudentLimits() {
    for (std::uint32_t degrees = 1; degrees <= tabulated_degrees; ++degrees)
        by_degrees_.push_back(squared_quantile(degrees));
}

double StudentLimits::squared(double degrees) const {
    if (degrees >= tabulated_degrees)
        return normal_squared + (by_degrees_.back() - normal_squared) * tabulated_degrees / degrees;
    // Linear in the inverse degrees, as beyond.
    const double whole = std::floor(degrees);
    const double low = by_degrees_[static_cast<std::size_t>(whole) - 1];
    const double high = by_degrees_[static_cast<std::size_t>(whole)];
    const double share = (1.0 / whole - 1.0 / degrees) * whole * (whole + 1.0);
    return low + (high - low) * share;
}

WelchTerm welch_term(const StudentLimits& limits, double degrees) {
    const double one = limits.squared(degrees);
    const double both = limits.squared(2.0 * degrees);
    return {static_cast<float>(one), static_cast<float>(one - both)};
}

}  // namespace weft
