// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/deadline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft::deadline_test {
namespace {

TEST(Deadline, IsTheTimeLessWhatWasSpentAndReserved) {
    double now = 5000.0;
    Deadline deadline(1000.0, 200.0, [&] { return now; });
    EXPECT_TRUE(deadline.is_set());
    EXPECT_EQ(deadline.ms(), 200.0);
    EXPECT_EQ(deadline.left_ms(), 800.0);
    EXPECT_EQ(deadline.share(), 0.2);
    now += 300.0;
    EXPECT_EQ(deadline.left_ms(), 500.0);
    EXPECT_EQ(deadline.share(), 0.5);
    deadline.reserve(200.0);
    EXPECT_EQ(deadline.left_ms(), 300.0);
    EXPECT_EQ(deadline.share(), 0.625);
    deadline.reserve(100.0);
    EXPECT_EQ(deadline.left_ms(), 400.0) << "in place of the reserve before";
    now += 1000.0;
    EXPECT_EQ(deadline.left_ms(), -600.0);
    EXPECT_EQ(deadline.share(), 1.0);
}

TEST(Deadline, AReserveBeyondTheTimeLeavesNone) {
    double now = 0.0;
    Deadline deadline(100.0, 0.0, [&] { return now; });
    deadline.reserve(200.0);
    EXPECT_EQ(deadline.left_ms(), -100.0);
    EXPECT_EQ(deadline.share(), 1.0);
    deadline.reserve(-50.0);
    EXPECT_EQ(deadline.left_ms(), 100.0);
}

TEST(Deadline, WithoutATimeThereIsNone) {
    Deadline deadline({}, 10.0);
    EXPECT_FALSE(deadline.is_set());
    deadline.reserve(1e9);
    EXPECT_TRUE(std::isinf(deadline.left_ms()) && deadline.left_ms() > 0.0);
    EXPECT_GE(deadline.ms(), 10.0);
}

}  // namespace
}  // namespace weft::deadline_test
