// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/prediction_interval.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "base/student_t.h"

namespace weft::prediction_interval_test {
namespace {

TEST(PredictionInterval, TwoMeasurementsGiveAClosedForm) {
    // s is |log 2| / sqrt 2, the mean log sqrt 8, and t that of one degree of freedom.
    const Interval interval = prediction_interval(std::array{2.0, 4.0});
    const double t = std::tan(0.95 * std::numbers::pi / 2.0);
    const double reach = t * std::log(2.0) / std::sqrt(2.0) * std::sqrt(1.5);
    EXPECT_DOUBLE_EQ(interval.median, 3.0);
    EXPECT_NEAR(std::log(interval.low), 0.5 * std::log(8.0) - reach, 1e-10);
    EXPECT_NEAR(std::log(interval.high), 0.5 * std::log(8.0) + reach, 1e-10);
}

TEST(PredictionInterval, EqualMeasurementsHaveAnIntervalWithoutWidth) {
    for (const double value : {5.0, 6.57132387963843e-05}) {
        const Interval interval = prediction_interval(std::array{value, value, value});
        EXPECT_EQ(interval.median, value);
        // The same once more lies within, whatever rounding does.
        EXPECT_LE(interval.low, value);
        EXPECT_GE(interval.high, value);
        EXPECT_NEAR(interval.low, value, 1e-14 * value);
        EXPECT_NEAR(interval.high, value, 1e-14 * value);
    }
}

TEST(PredictionInterval, OnALinearScaleIsOfTheValuesThemselves) {
    const std::array values{1e-6, 2.0, 4.0 - 1e-6};
    const Interval interval = prediction_interval(values, 0.95, IntervalScale::linear);
    EXPECT_EQ(interval.median, 2.0);
    EXPECT_EQ(interval.low, 0.0);
    const double deviation = 2.0 - 1e-6;
    EXPECT_NEAR(interval.high, 2.0 + student_t_quantile(0.95, 2) * deviation * std::sqrt(4.0 / 3.0),
                1e-12);
    EXPECT_GT(prediction_interval(values).high, 1e9 * interval.high);
}

TEST(PredictionInterval, IsAsWideInRatioWhateverTheUnit) {
    const Interval small = prediction_interval(std::array{1e-9, 1.5e-9, 3e-9});
    const Interval large = prediction_interval(std::array{1e9, 1.5e9, 3e9});
    EXPECT_NEAR(small.high / small.low, large.high / large.low, 1e-9 * large.high / large.low);
}

TEST(PredictionInterval, ZerosAreMeasuredOnTheirOwnScale) {
    const Interval interval = prediction_interval(std::array{0.0, 0.0, 3.0});
    const double reach = student_t_quantile(0.95, 2) * std::sqrt(3.0) * std::sqrt(4.0 / 3.0);
    EXPECT_DOUBLE_EQ(interval.median, 0.0);
    EXPECT_DOUBLE_EQ(interval.low, 0.0);
    EXPECT_NEAR(interval.high, 1.0 + reach, 1e-10);
    const Interval none = prediction_interval(std::array{0.0, 0.0});
    EXPECT_EQ(none.low, 0.0);
    EXPECT_EQ(none.high, 0.0);
}

TEST(PredictionInterval, EndsAreFiniteHoweverFarMeasurementsLieApart) {
    const Interval interval = prediction_interval(std::array{1e-300, 1.0});
    EXPECT_TRUE(std::isfinite(interval.high));
    EXPECT_GT(interval.high, 1e300);
    EXPECT_GE(interval.low, 0.0);
}

TEST(PredictionInterval, NeedsTwoMeasurements) {
    EXPECT_THROW((void)prediction_interval(std::array{1.0}), std::invalid_argument);
}

/// Share of trials in which one more measurement lies within the interval of `count` ones.
double coverage_of(std::size_t count, double confidence, int trials) {
    std::mt19937_64 random(20261123 + count);
    std::lognormal_distribution<double> measurement(3.0, 0.4);
    int inside = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> values(count);
        for (double& value : values) value = measurement(random);
        const Interval interval = prediction_interval(values, confidence);
        const double next = measurement(random);
        if (next >= interval.low && next <= interval.high) ++inside;
    }
    return static_cast<double>(inside) / trials;
}

TEST(PredictionInterval, HoldsTheNextMeasurementAsOftenAsItSays) {
    constexpr int trials = 20000;
    // Four standard deviations of the share: less than one seed in ten thousand goes beyond.
    for (const double confidence : {0.95, 0.5})
        for (const std::size_t count : {2U, 3U, 5U, 10U}) {
            const double tolerance = 4.0 * std::sqrt(confidence * (1.0 - confidence) / trials);
            EXPECT_NEAR(coverage_of(count, confidence, trials), confidence, tolerance) << count;
        }
}

}  // namespace
}  // namespace weft::prediction_interval_test
