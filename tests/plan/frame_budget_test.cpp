// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/frame_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <vector>

#include "tests/testing/image_masks.h"

namespace weft::frame_budget_test {
namespace {

using test::RandomBits;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double bad = std::numeric_limits<double>::quiet_NaN();

const std::vector<ThresholdScope> indirect{{"indirect", true, true}};
const std::vector<ThresholdScope> both{{"direct", true, true}, {"indirect", true, true}};

TEST(FrameBudget, WithoutATargetAllGainsAreOne) {
    for (const double target : {0.0, -1.0, infinity, -infinity, bad}) {
        FrameBudget budget(target);
        EXPECT_FALSE(budget.has_target()) << target;
        for (const double used : {1e-3, 1.0, 1e9}) budget.spend(used, both);
        EXPECT_EQ(budget.gain("direct"), 1.0) << target;
    }
    EXPECT_FALSE(FrameBudget().has_target());
}

TEST(FrameBudget, FollowsTheFormula) {
    struct Case {
        double used, factor;
    };
    for (const Case& one : {Case{100.0, 1.0}, Case{121.0, 1.1}, Case{81.0, 0.9}, Case{64.0, 0.8},
                            Case{1.0, 0.8}, Case{156.25, 1.25}, Case{1e300, 1.25}}) {
        FrameBudget budget(100.0);
        EXPECT_EQ(budget.gain("direct"), 1.0);
        budget.spend(one.used, both);
        EXPECT_NEAR(budget.gain("direct"), one.factor, 1e-12) << one.used;
        budget.spend(one.used, indirect);
        EXPECT_NEAR(budget.gain("direct"), one.factor, 1e-12) << "it had no part in the frame";
        EXPECT_NEAR(budget.gain("indirect"), one.factor * one.factor, 1e-12) << one.used;
    }
}

TEST(FrameBudget, TimesThatAreNoTimesSayNothing) {
    FrameBudget budget(10.0);
    budget.spend(12.0, both);
    const double gain = budget.gain("direct");
    EXPECT_GT(gain, 1.0);
    for (const double used : {0.0, -0.0, -5.0, bad, infinity, -infinity}) {
        budget.spend(used, both);
        EXPECT_EQ(budget.gain("direct"), gain) << used;
    }
    budget.spend(12.0, {});
    EXPECT_EQ(budget.gain("direct"), gain);
}

TEST(FrameBudget, NeverLeavesItsRange) {
    RandomBits random(1);
    for (const double target : {5e-324, 1e-300, 1.0, 40.0, 1e300}) {
        FrameBudget budget(target);
        for (int frame = 0; frame < 2000; ++frame) {
            // Long runs of one kind drive it to both ends.
            const bool slow = frame / 100 % 2 == 0;
            const double used =
                std::exp((static_cast<double>(random.unit()) - (slow ? 0.2 : 0.8)) * 1400.0);
            budget.spend(used, both);
            EXPECT_GE(budget.gain("direct"), 1.0 / greatest_gain);
            EXPECT_LE(budget.gain("direct"), greatest_gain);
        }
    }
}

TEST(FrameBudget, GainsThatChangeNothingDoNotRunAway) {
    FrameBudget budget(100.0);
    const std::vector<ThresholdScope> scopes{{"coarse", false, true}, {"full", true, false}};
    for (int frame = 0; frame < 20; ++frame) budget.spend(1000.0, scopes);
    EXPECT_EQ(budget.gain("coarse"), 1.0);
    EXPECT_EQ(budget.gain("full"), greatest_gain);
    for (int frame = 0; frame < 40; ++frame) budget.spend(1.0, scopes);
    EXPECT_EQ(budget.gain("coarse"), 1.0 / greatest_gain);
    EXPECT_EQ(budget.gain("full"), greatest_gain);
}

/// Milliseconds of a frame: what no threshold changes, and samples that fall with a power of it.
struct CostModel {
    double fixed, adaptive, exponent;
    std::size_t hold;  ///< images for which a raised level stays
    double noise;      ///< relative

    /// With the gains of the last frames, the newest last.
    [[nodiscard]] double ms(const std::deque<double>& gains, RandomBits& random) const {
        const double least = *std::min_element(gains.begin(), gains.end());
        const double spread = 1.0 + noise * (2.0 * static_cast<double>(random.unit()) - 1.0);
        return (fixed + adaptive * std::pow(least, -exponent)) * spread;
    }
};

TEST(FrameBudget, ConvergesOnAModelOfCost) {
    // A tile that a low gain has raised stays for some images, so cost follows the least gain of
    // these. Every target below can be reached within the range.
    RandomBits random(2);
    for (const double exponent : {0.2, 0.5, 1.0})
        for (const std::size_t hold : {std::size_t{0}, std::size_t{4}})
            for (const double noise : {0.0, 0.1})
                for (const double start : {0.7, 1.0, 1.4}) {
                    const CostModel model{20.0, 60.0, exponent, hold, noise};
                    // The frame time at a gain that is reached within the range.
                    const double target = 20.0 + 60.0 * std::pow(start * 1.5, -exponent);
                    FrameBudget budget(target);
                    std::deque<double> gains;
                    std::vector<double> times;
                    for (int frame = 0; frame < 300; ++frame) {
                        gains.push_back(budget.gain("indirect"));
                        if (gains.size() > hold + 1) gains.pop_front();
                        times.push_back(model.ms(gains, random));
                        budget.spend(times.back(), indirect);
                    }
                    const auto tail = times.end() - 100;
                    const double mean = std::accumulate(tail, times.end(), 0.0) / 100.0;
                    const double worst = *std::max_element(tail, times.end());
                    // The mean of noise over 100 frames, and half its range beside the way it takes
                    // through the gains.
                    EXPECT_NEAR(mean / target, 1.0, 0.01 + 0.2 * noise)
                        << exponent << ' ' << hold << ' ' << noise << ' ' << start;
                    EXPECT_LT(worst / target, 1.01 + 2.5 * noise)
                        << exponent << ' ' << hold << ' ' << noise << ' ' << start;
                }
}

TEST(FrameBudget, WhatCannotBeReachedEndsAtTheEndOfTheRange) {
    for (const auto& [target, end] : {std::pair{10.0, greatest_gain}, {1e6, 1.0 / greatest_gain}}) {
        FrameBudget budget(target);
        RandomBits random(3);
        const CostModel model{20.0, 60.0, 0.5, 0, 0.0};
        for (int frame = 0; frame < 100; ++frame)
            budget.spend(model.ms({budget.gain("indirect")}, random), indirect);
        EXPECT_EQ(budget.gain("indirect"), end) << target;
    }
}

}  // namespace
}  // namespace weft::frame_budget_test
