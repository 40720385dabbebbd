// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_WELCH_TEST_H
#define WEFT_DENOISE_WELCH_TEST_H

#include <algorithm>
#include <limits>
#include <vector>

namespace weft {

/// Squares of the critical values of Student's t-test at a level of 0.5 %: of two equal means it
/// takes noise for a difference that often.
class StudentLimits {
  public:
    StudentLimits();

    /// The square of the critical value for so many degrees of freedom, 1 and up.
    [[nodiscard]] double squared(double degrees) const;

  private:
    std::vector<double> by_degrees_;
};

/// The part of Welch's t-test of two means that each of them brings along.
struct WelchTerm {
    float one = 0.0F;   ///< squared critical value where this mean has all of the variance
    float drop = 0.0F;  ///< how far it falls where both means have the same variance
};

/// The term of a mean whose variance is known with so many degrees of freedom.
[[nodiscard]] WelchTerm welch_term(const StudentLimits& limits, double degrees);

/// The largest squared difference of two means that Welch's test takes for noise, for means of the
/// variances v and w. Of means with d degrees of freedom each, the difference has d where one mean
/// has all of the variance, and 2 d where both have the same. There the squared critical value is
/// exact, and between it is linear in the inverse degrees.
[[nodiscard]] inline float welch_limit(const WelchTerm& a, float v, const WelchTerm& b, float w) {
    const float share = w / std::max(v + w, std::numeric_limits<float>::min());
    return a.one * v + b.one * w - 2.0F * (a.drop + b.drop) * v * share;
}

}  // namespace weft

#endif
