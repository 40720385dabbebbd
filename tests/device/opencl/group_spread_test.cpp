// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/group_spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft::group_spread_test {
namespace {

/// Whether the group has work where the first `busy` of all groups' work is there, by WORK_ITEM.
bool has_work(std::uint32_t group, std::uint32_t groups, std::uint32_t busy) {
    return group * group_spread(groups) % groups < busy;
}

TEST(GroupSpread, ShortLaunchesHaveAGroupForEachItem) {
    EXPECT_EQ(busy_groups(64, 0), 1U) << "launches that only build a program";
    EXPECT_EQ(busy_groups(64, 1), 1U);
    EXPECT_EQ(busy_groups(64, 63), 63U);
    EXPECT_EQ(busy_groups(64, 64), 64U);
    EXPECT_EQ(busy_groups(64, 500), 64U);
}

TEST(GroupSpread, EveryGroupIsTakenOnce) {
    for (std::uint32_t groups = 1; groups <= 600; ++groups) {
        std::vector<int> taken(groups);
        for (std::uint32_t group = 0; group < groups; ++group)
            ++taken[group * group_spread(groups) % groups];
        EXPECT_EQ(std::ranges::count(taken, 1), groups) << groups;
    }
}

// Drivers give a thread a half, a quarter or an eighth of the groups that are left. The discrepancy
// of a rotation by about the golden section grows as the logarithm of the number of groups
// (Niederreiter 1992, chapter 3): by one here for each time that it doubles.
TEST(GroupSpread, PartsOfTheGroupsGetTheirShareOfTheWork) {
    for (const std::uint32_t groups : {32U, 64U, 128U, 255U, 512U, 1000U, 2048U, 8192U})
        for (const std::uint32_t parts : {2U, 4U, 8U})
            for (std::uint32_t busy = parts; busy < groups; busy += 1 + busy / 7)
                for (std::uint32_t part = 0; part < parts; ++part) {
                    std::uint32_t share = 0;
                    for (std::uint32_t i = part * groups / parts; i < (part + 1) * groups / parts;
                         ++i)
                        share += has_work(i, groups, busy) ? 1 : 0;
                    EXPECT_NEAR(share, static_cast<double>(busy) / parts, std::log2(groups))
                        << busy << " of " << groups << ", part " << part << " of " << parts;
                }
}

// The largest launch: the kernel multiplies in 32 bits.
TEST(GroupSpread, ProductsFitIn32Bits) {
    constexpr std::uint64_t groups = 65535;
    EXPECT_LT((groups - 1) * group_spread(groups), std::uint64_t{1} << 32U);
}

}  // namespace
}  // namespace weft::group_spread_test
