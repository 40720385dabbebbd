// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/welch_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "base/student_t.h"

namespace weft::welch_test_test {
namespace {

TEST(WelchTest, LimitsAreQuantilesOfStudentsDistribution) {
    const StudentLimits limits;
    for (const std::uint32_t degrees : {1U, 2U, 3U, 15U, 63U, 64U})
        EXPECT_NEAR(std::sqrt(limits.squared(degrees)), student_t_quantile(0.995, degrees), 1e-9)
            << degrees;
    // Beyond those of a table, three digits.
    for (const std::uint32_t degrees : {65U, 127U, 1000U, 20000U})
        EXPECT_NEAR(std::sqrt(limits.squared(degrees)), student_t_quantile(0.995, degrees), 2e-3)
            << degrees;
    // Between whole numbers they fall all the way.
    for (double degrees = 1.0; degrees < 70.0; degrees += 0.125)
        EXPECT_GT(limits.squared(degrees), limits.squared(degrees + 0.125)) << degrees;
}

/// The squared critical value of Welch's test of means with these variances, which are known with
/// that many degrees of freedom each.
double welch_squared(const StudentLimits& limits, double v, double w, double degrees) {
    const double welch = degrees * (v + w) * (v + w) / (v * v + w * w);
    return limits.squared(welch);
}

TEST(WelchTest, LimitIsThatOfWelch) {
    const StudentLimits limits;
    for (const double degrees : {3.0, 15.0, 63.0, 1023.0}) {
        const WelchTerm term = welch_term(limits, degrees);
        for (const double ratio : {0.0, 1.0})
            EXPECT_NEAR(welch_limit(term, 4.0F, term, static_cast<float>(4.0 * ratio)) /
                            (4.0 * (1.0 + ratio)),
                        welch_squared(limits, 1.0, ratio, degrees), 1e-5 * limits.squared(degrees));
        // The test is linear in the inverse degrees where the quantile is only nearly so.
        for (const double ratio : {0.05, 0.2, 0.5, 0.8}) {
            const double expected = welch_squared(limits, 1.0, ratio, degrees);
            const double found =
                welch_limit(term, 1.0F, term, static_cast<float>(ratio)) / (1.0 + ratio);
            EXPECT_GE(found, expected * (1.0 - 1e-5));
            EXPECT_LE(found, expected * (degrees < 10.0 ? 1.25 : 1.02));
            EXPECT_FLOAT_EQ(welch_limit(term, 1.0F, term, static_cast<float>(ratio)),
                            welch_limit(term, static_cast<float>(ratio), term, 1.0F));
        }
    }
}

TEST(WelchTest, EqualsAreToldApartAsOftenAsItsLevelSays) {
    constexpr int samples = 8;
    constexpr int trials = 100000;
    const StudentLimits limits;
    const WelchTerm term = welch_term(limits, samples - 1.0);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    struct Mean {
        double mean, variance;
    };
    const auto mean_of = [&](double deviation) {
        double sum = 0.0;
        double squares = 0.0;
        for (int k = 0; k < samples; ++k) {
            const double value = deviation * normal(random);
            sum += value;
            squares += value * value;
        }
        return Mean{sum / samples, (squares - sum * sum / samples) / (samples * (samples - 1.0))};
    };
    for (const double deviation : {1.0, 3.0}) {
        int apart = 0;
        for (int trial = 0; trial < trials; ++trial) {
            const Mean a = mean_of(1.0);
            const Mean b = mean_of(deviation);
            const double difference = a.mean - b.mean;
            if (difference * difference > welch_limit(term, static_cast<float>(a.variance), term,
                                                      static_cast<float>(b.variance)))
                ++apart;
        }
        // 500 of them; Welch's test itself is off by up to a tenth for so few samples, and five
        // standard deviations of the count are 112.
        EXPECT_GT(apart, 330) << deviation;
        EXPECT_LT(apart, 670) << deviation;
    }
}

TEST(WelchTest, MeansWithoutVarianceHaveToBeEqual) {
    const WelchTerm term = welch_term(StudentLimits(), 15.0);
    EXPECT_EQ(welch_limit(term, 0.0F, term, 0.0F), 0.0F);
}

}  // namespace
}  // namespace weft::welch_test_test
