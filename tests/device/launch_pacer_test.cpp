// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/launch_pacer.h"

#include <gtest/gtest.h>

namespace weft::launch_pacer_test {
namespace {

constexpr KernelId kernel = KernelId::path;
constexpr std::uint32_t most = 1U << 14;
constexpr std::uint32_t least = 16;

/// Work-items of the launches of a workload whose items take so long.
std::vector<std::uint32_t> launches(LaunchPacer& pacer, double ms_per_item, int count) {
    std::vector<std::uint32_t> all;
    for (int i = 0; i < count; ++i) {
        all.push_back(pacer.items(kernel, most));
        pacer.took(kernel, most, all.back(), all.back() * ms_per_item);
    }
    return all;
}

TEST(LaunchPacer, LaunchesOfSlowItemsComeToTheirTime) {
    LaunchPacer pacer(least);
    const double ms = LaunchPacer::launch_ms / 500.0;
    const auto all = launches(pacer, ms, 12);
    EXPECT_LE(all.front(), most / 8) << "nothing is known at first";
    EXPECT_NEAR(all.back(), 500.0, least);
}

TEST(LaunchPacer, LaunchesOfFastItemsAreAsLargeAsTheyMay) {
    LaunchPacer pacer(least);
    const auto all = launches(pacer, LaunchPacer::launch_ms / most / 10.0, 12);
    EXPECT_EQ(all.back(), most);
    for (std::size_t i = 1; i < all.size(); ++i) EXPECT_LE(all[i], 4 * all[i - 1]);
}

TEST(LaunchPacer, LaunchesGetSmallerAtOnceAndLargerSlowly) {
    LaunchPacer pacer(least);
    (void)launches(pacer, LaunchPacer::launch_ms / 4000.0, 20);
    pacer.took(kernel, most, 4000, 10.0 * LaunchPacer::launch_ms);
    const std::uint32_t small = pacer.items(kernel, most);
    EXPECT_LE(small, 400U);
    pacer.took(kernel, most, small, small * LaunchPacer::launch_ms / 4000.0);
    EXPECT_LE(pacer.items(kernel, most), 2 * small);
}

TEST(LaunchPacer, NoLaunchIsTooSmallOrTooLarge) {
    LaunchPacer pacer(least);
    EXPECT_EQ(launches(pacer, 1000.0, 5).back(), least);
    EXPECT_EQ(pacer.items(KernelId::compose, 3), 3U);
    EXPECT_EQ(pacer.items(KernelId::gbuffer, 1), 1U);
}

TEST(LaunchPacer, AnotherWorkloadOfTheKernelIsNotKnown) {
    LaunchPacer pacer(least);
    (void)launches(pacer, LaunchPacer::launch_ms / most / 10.0, 12);
    EXPECT_LT(pacer.items(kernel, 2 * most), most);
}

}  // namespace
}  // namespace weft::launch_pacer_test
