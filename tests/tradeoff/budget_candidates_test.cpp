// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/budget_candidates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace weft::budget_candidates_test {
namespace {

Candidate high() {
    Candidate candidate;
    candidate.family = "ais";
    candidate.variant = "high";
    candidate.preset.sampling.threshold = 3.0;
    return with_samples(candidate, 1);
}

std::vector<std::uint32_t> counts(double sample_ms, const std::vector<double>& budgets,
                                  std::uint32_t most, const Candidate& base = high()) {
    std::vector<std::uint32_t> samples;
    for (const Candidate& candidate : budget_candidates(base, sample_ms, {budgets, most})) {
        EXPECT_EQ(candidate.name, "ais high spp " + std::to_string(candidate.preset.samples));
        EXPECT_EQ(candidate.preset.sampling.threshold, 3.0);
        samples.push_back(candidate.preset.samples);
    }
    return samples;
}

using Counts = std::vector<std::uint32_t>;

TEST(BudgetCandidates, UseUpHalfAndFourFifthsOfEveryBudget) {
    EXPECT_EQ(counts(10.0, {300.0}, 1000), (Counts{16, 24}));
    EXPECT_EQ(counts(10.0, {1000.0, 300.0}, 1000), (Counts{16, 24, 55, 82}));
    // Two budgets that come to the same numbers ask once.
    EXPECT_EQ(counts(10.0, {300.0, 301.0}, 1000), (Counts{16, 24}));
}

TEST(BudgetCandidates, LeaveRoomForWhatComesAfterTheSamples) {
    const std::vector<double> budgets{300.0};
    std::vector<std::uint32_t> samples;
    for (const Candidate& candidate : budget_candidates(high(), 10.0, {budgets, 1000}, 100.0))
        samples.push_back(candidate.preset.samples);
    EXPECT_EQ(samples, (Counts{6, 14}));  // 65 and 146 ms
    EXPECT_TRUE(budget_candidates(high(), 10.0, {budgets, 1000}, 300.0).empty());
}

TEST(BudgetCandidates, KeepToTheMostSamplesAndLeaveOutThoseThatAreThere) {
    EXPECT_EQ(counts(1.0, {300.0, 1000.0}, 200), (Counts{165, 200}));
    EXPECT_EQ(counts(10.0, {300.0}, 1000, with_samples(high(), 16)), (Counts{24}));
    EXPECT_EQ(counts(10.0, {300.0}, 1), Counts{});
}

TEST(BudgetCandidates, AreNoneWhereThereIsNoTimeForTwoSamples) {
    EXPECT_EQ(counts(130.0, {300.0}, 1000), Counts{});
    EXPECT_EQ(counts(122.0, {300.0}, 1000), Counts{2});
    EXPECT_EQ(counts(10.0, {}, 1000), Counts{});
}

TEST(BudgetCandidates, AreNoneForTimesThatSayNothing) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double sample_ms : {0.0, -1.0, infinity, std::nan("")})
        EXPECT_EQ(counts(sample_ms, {300.0}, 1000), Counts{}) << sample_ms;
    EXPECT_EQ(counts(1e-300, {1e300}, 4000000000U), Counts{4000000000U});
}

}  // namespace
}  // namespace weft::budget_candidates_test
