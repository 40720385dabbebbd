// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/pareto_front.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace weft::pareto_front_test {
namespace {

using Points = std::vector<CostAndError>;

/// By the definition.
std::vector<bool> by_definition(const Points& points) {
    std::vector<bool> on_front;
    for (const CostAndError& point : points) {
        bool beaten = false;
        for (const CostAndError& other : points) {
            const bool no_worse = other.cost <= point.cost && other.error <= point.error;
            const bool better = other.cost < point.cost || other.error < point.error;
            beaten = beaten || (no_worse && better);
        }
        on_front.push_back(!beaten);
    }
    return on_front;
}

TEST(ParetoFront, OfNothingAndOfOnePoint) {
    EXPECT_TRUE(pareto_front({}).empty());
    EXPECT_EQ(pareto_front(Points{{3.0, 7.0}}), std::vector<bool>{true});
}

TEST(ParetoFront, LeavesOutWhatIsBeaten) {
    const Points points{{1.0, 9.0}, {2.0, 9.0}, {2.0, 4.0}, {1.0, 10.0}, {3.0, 4.0}, {9.0, 0.0}};
    EXPECT_EQ(pareto_front(points), (std::vector<bool>{true, false, true, false, false, true}));
}

TEST(ParetoFront, TreatsEqualPointsAlike) {
    const Points points{{1.0, 5.0}, {2.0, 3.0}, {1.0, 5.0}, {2.0, 3.0}, {2.0, 5.0}};
    EXPECT_EQ(pareto_front(points), (std::vector<bool>{true, true, true, true, false}));
}

TEST(ParetoFront, WhatIsNoNumberIsNotOnItAndBeatsNothing) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Points points{{1.0, nan},      {2.0, 3.0}, {nan, 0.0}, {3.0, 5.0},
                        {infinity, 0.0}, {9.0, 1.0}, {nan, nan}, {0.0, infinity}};
    EXPECT_EQ(pareto_front(points),
              (std::vector<bool>{false, true, false, false, false, true, false, false}));
    // In this order, comparing with it would have let all that follows pass.
    EXPECT_EQ(pareto_front(Points{{nan, nan}, {1.0, 1.0}, {2.0, 2.0}}),
              (std::vector<bool>{false, true, false}));
    EXPECT_EQ(pareto_front(Points{{nan, 1.0}}), std::vector<bool>{false});
}

TEST(ParetoFront, OfEqualErrorsTheFastestAlone) {
    EXPECT_EQ(pareto_front(Points{{2.0, 5.0}, {1.0, 5.0}, {3.0, 5.0}}),
              (std::vector<bool>{false, true, false}));
}

TEST(ParetoFront, AgreesWithItsDefinition) {
    std::mt19937 random(1);
    // Few values: ties in one or both are common.
    std::uniform_int_distribution<int> value(0, 9);
    std::uniform_int_distribution<int> size(1, 40);
    for (int trial = 0; trial < 500; ++trial) {
        Points points(static_cast<std::size_t>(size(random)));
        for (CostAndError& point : points)
            point = {static_cast<double>(value(random)), static_cast<double>(value(random))};
        ASSERT_EQ(pareto_front(points), by_definition(points)) << trial;
    }
}

}  // namespace
}  // namespace weft::pareto_front_test
