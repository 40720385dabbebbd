// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_BUDGET_CANDIDATES_H
#define WEFT_TRADEOFF_BUDGET_CANDIDATES_H

#include <cstdint>
#include <span>
#include <vector>

#include "tradeoff/settings_sweep.h"

namespace weft {

/// The times of images for which advice is wanted, and the limit on samples.
struct BudgetWish {
    std::span<const double> budgets_ms;
    std::uint32_t most_samples = 1;  ///< per pixel
};

/// The settings of `base` with as many samples as use budgets up: about half of each budget, and
/// about four fifths, which may exceed the budget on a machine whose times scatter. `sample_ms`:
/// time of one sample of every pixel; `fixed_ms`: of an image besides its samples. By rising
/// samples, each number once, without that of `base`; none where there is no time for two samples,
/// or `sample_ms` is not a positive time.
[[nodiscard]] std::vector<Candidate> budget_candidates(const Candidate& base, double sample_ms,
                                                       const BudgetWish& wish,
                                                       double fixed_ms = 0.0);

}  // namespace weft

#endif
