// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include "device/opencl/compile_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace weft::compile_estimate_test {
namespace {

/// When programs that take so long are done, ascending, by workers that take them in this order.
std::vector<double> ends(const std::vector<double>& times, std::size_t workers) {
    std::vector<double> free(workers, 0.0);
    std::vector<double> result;
    for (const double time : times) {
        const auto next = std::min_element(free.begin(), free.end());
        *next += time;
        result.push_back(*next);
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// That what is said to be left, from the first completed program to the last, is right within a
/// factor of two, but for the last twentieth of the time.
void expect_within_two(const std::vector<double>& expected, const std::vector<double>& real,
                       std::uint32_t workers, const std::string& when) {
    CompileEstimate estimate(expected, workers);
    const std::vector<double> done_at = ends(real, workers);
    const double all = done_at.back();
    for (double now = 0.0; now < all; now += all / 200.0) {
        const auto done = static_cast<std::size_t>(
            std::upper_bound(done_at.begin(), done_at.end(), now) - done_at.begin());
        const double left = estimate.left_ms(done, now);
        if (done == 0 || all - now < 0.05 * all) continue;
        EXPECT_GT(left, 0.5 * (all - now)) << when << " at " << now << " of " << all;
        EXPECT_LT(left, 2.0 * (all - now)) << when << " at " << now << " of " << all;
    }
}

const std::vector<double> times{1900, 1700, 1500, 900, 850, 420, 400, 400, 380, 310, 300, 200, 90};

TEST(CompileEstimate, KnownTimesAreRightFromTheStart) {
    for (const std::uint32_t workers : {1U, 2U, 8U}) {
        CompileEstimate estimate(times, workers);
        EXPECT_DOUBLE_EQ(estimate.left_ms(0, 0.0), ends(times, workers).back());
        expect_within_two(times, times, workers, "known");
    }
}

TEST(CompileEstimate, ASlowerOrFasterMachineIsNoticedAtTheFirstProgram) {
    for (const double factor : {0.2, 0.5, 2.0, 5.0}) {
        std::vector<double> real = times;
        for (double& time : real) time *= factor;
        expect_within_two(times, real, 2, std::to_string(factor));
    }
}

TEST(CompileEstimate, SingleTimesMayBeWrong) {
    std::vector<double> real = times;
    for (std::size_t i = 0; i < real.size(); ++i) real[i] *= i % 2 == 0 ? 1.3 : 0.7;
    expect_within_two(times, real, 2, "scattered");
}

TEST(CompileEstimate, NeverClaimsToBeDoneBeforeItIs) {
    CompileEstimate estimate({100.0, 100.0}, 1);
    EXPECT_GE(estimate.left_ms(0, 1000.0), 1000.0) << "the first took ten times as long already";
    EXPECT_GE(estimate.left_ms(1, 1000.0), 1000.0);
    EXPECT_EQ(estimate.left_ms(2, 2000.0), 0.0);
    EXPECT_EQ(CompileEstimate({}, 2).left_ms(0, 0.0), 0.0);
}

}  // namespace
}  // namespace weft::compile_estimate_test

#endif
