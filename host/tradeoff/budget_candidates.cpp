// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/budget_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace weft {
namespace {

// Shares of a budget that candidates use. An interval may end at 1.2 times the budget, so these
// leave room for times that scatter by factors of 2.2 and 1.46.
constexpr std::array shares = {0.55, 0.82};

}  // namespace

std::vector<Candidate> budget_candidates(const Candidate& base, double sample_ms,
                                         const BudgetWish& wish, double fixed_ms) {
    if (!(sample_ms > 0.0) || !std::isfinite(sample_ms)) return {};
    std::set<std::uint32_t> counts;
    for (const double budget : wish.budgets_ms)
        for (const double share : shares) {
            const double fitting = std::floor((share * budget - fixed_ms) / sample_ms);
            if (fitting >= 2.0)
                counts.insert(static_cast<std::uint32_t>(
                    std::min(fitting, static_cast<double>(wish.most_samples))));
        }
    counts.erase(base.preset.samples);
    std::vector<Candidate> candidates;
    for (const std::uint32_t samples : counts)
        if (samples >= 2) candidates.push_back(with_samples(base, samples));
    return candidates;
}

}  // namespace weft
