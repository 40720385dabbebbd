// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/plot_axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace weft::plot_axis_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<std::string> names(const PlotAxis& axis) {
    std::vector<std::string> texts;
    for (const AxisTick& tick : axis.ticks())
        if (!tick.text.empty()) texts.push_back(tick.text);
    return texts;
}

TEST(PlotAxis, LogarithmicPositionsGrowWithTheLogarithm) {
    const PlotAxis axis(AxisScale::logarithmic, std::vector{10.0, 1000.0});
    // 4 % of two decades on each side.
    EXPECT_NEAR(axis.low(), std::pow(10.0, 0.92), 1e-9);
    EXPECT_NEAR(axis.high(), std::pow(10.0, 3.08), 1e-6);
    EXPECT_NEAR(axis.position(10.0), 0.08 / 2.16, 1e-12);
    EXPECT_NEAR(axis.position(100.0), 0.5, 1e-12);
    EXPECT_EQ(axis.position(1e9), 1.0);
    EXPECT_EQ(names(axis),
              (std::vector<std::string>{"10", "20", "50", "100", "200", "500", "1000"}));
}

TEST(PlotAxis, LinearAxesOfWhatIsNotNegativeStartAtZero) {
    const PlotAxis axis(AxisScale::linear, std::vector{3.0, 10.0});
    EXPECT_EQ(axis.low(), 0.0);
    EXPECT_NEAR(axis.position(5.2), 0.5, 1e-12);
    EXPECT_EQ(names(axis), (std::vector<std::string>{"0", "2", "4", "6", "8", "10"}));
    const PlotAxis signs(AxisScale::linear, std::vector{-1.0, 1.0});
    EXPECT_NEAR(signs.position(0.0), 0.5, 1e-12);
}

TEST(PlotAxis, AlwaysHasTwoNamedTicksInOrder) {
    const std::vector<std::vector<double>> many = {
        {},         {5.0},          {0.031, 0.032}, {1.0, 1.0 + 1e-15}, {1e-300, 1e300},
        {1e-7, 40}, {2.2, 4.4},     {1e300},        {1e-300},           {0.0, -1.0, infinity},
        {3.0, 3e5}, {std::nan("")}, {6.0, 9.0},     {1e12, 1.1e12}};
    for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic})
        for (const std::vector<double>& values : many) {
            const PlotAxis axis(scale, values);
            ASSERT_LT(axis.low(), axis.high());
            EXPECT_GE(names(axis).size(), 2U) << axis.low() << " to " << axis.high();
            EXPECT_LE(axis.ticks().size(), 60U);
            double last = -infinity;
            for (const AxisTick& tick : axis.ticks()) {
                ASSERT_TRUE(has_place(tick.value, scale)) << tick.value;
                EXPECT_GT(tick.value, last);
                last = tick.value;
                EXPECT_GE(tick.value, axis.low() - 1e-6 * std::abs(axis.low()));
                EXPECT_LE(tick.value, axis.high() + 1e-6 * std::abs(axis.high()));
            }
            for (const double value : values)
                if (has_place(value, scale)) {
                    EXPECT_GE(axis.position(value), 0.0);
                    EXPECT_LE(axis.position(value), 1.0);
                }
        }
}

TEST(PlotAxis, KnowsWhatHasNoPlace) {
    for (const double value : {infinity, -infinity, std::nan(""), 1e301}) {
        EXPECT_FALSE(has_place(value, AxisScale::linear));
        EXPECT_FALSE(has_place(value, AxisScale::logarithmic));
    }
    for (const double value : {0.0, -1.0, 1e-305}) {
        EXPECT_TRUE(has_place(value, AxisScale::linear));
        EXPECT_FALSE(has_place(value, AxisScale::logarithmic));
    }
}

}  // namespace
}  // namespace weft::plot_axis_test
