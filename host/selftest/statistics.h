// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_STATISTICS_H
#define WEFT_SELFTEST_STATISTICS_H

#include <cstddef>
#include <vector>

namespace weft::selftest {

/// Mean of independent estimates and its standard error.
struct Estimate {
    double mean = 0.0;
    double error = 0.0;
};

/// Estimates the mean from at least two values.
[[nodiscard]] Estimate estimate(const std::vector<double>& values);

/// How many standard errors a normal variable may be off (either way), so that `comparisons`
/// independent ones of a correct renderer together fail with the probability `failure` (Sidak
/// 1967).
[[nodiscard]] double sidak_limit(std::size_t comparisons, double failure = 1e-4);

/// P(|T| > t) of Student's t with `freedom` degrees of freedom, by quadrature.
[[nodiscard]] double student_tail(double t, double freedom);

/// How many standard errors the mean of `values` normal variables, which the standard error is
/// estimated from, may be off; `comparisons` and `failure` as in sidak_limit.
[[nodiscard]] double student_limit(std::size_t values, std::size_t comparisons, double failure);

}  // namespace weft::selftest

#endif
