// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_RATIO_H
#define WEFT_BENCH_PATH_RATIO_H

#include <vector>

namespace weft::bench {

/// A measured quantity above 0 and how sure it is.
struct Ratio {
    double value = 0.0;
    double spread = 0.0;  ///< standard error of its logarithm: 0.1 is about 10 %
};

/// The product or quotient of quantities that were measured independently.
[[nodiscard]] Ratio operator*(const Ratio& a, const Ratio& b);
[[nodiscard]] Ratio operator/(const Ratio& a, const Ratio& b);

/// The geometric mean of some quantities; 0 of none.
[[nodiscard]] Ratio geometric_mean(const std::vector<Ratio>& ratios);

/// A quantity of some repetitions, `value`, and what it is where each of them in turn is left out.
/// The spread is the jackknife's.
[[nodiscard]] Ratio jackknife(double value, const std::vector<double>& without);

/// The median of pairs' quotients, the i-th of `above` over the i-th of `below`. The spread is that
/// of a median of normal deviates as wide as the quotients' median deviation tells, so that a pair
/// that was disturbed counts no more than another one.
[[nodiscard]] Ratio paired_ratio(const std::vector<double>& above,
                                 const std::vector<double>& below);

}  // namespace weft::bench

#endif
