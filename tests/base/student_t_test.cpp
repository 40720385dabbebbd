// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/student_t.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace weft::student_t_test {
namespace {

TEST(StudentT, StudentsDistributionHasItsClosedForms) {
    for (const double t : {0.0, 0.3, 1.0, 2.5, 40.0}) {
        EXPECT_NEAR(student_t_coverage(t, 1), 2.0 / std::numbers::pi * std::atan(t), 1e-14);
        EXPECT_NEAR(student_t_coverage(t, 2), t / std::sqrt(2.0 + t * t), 1e-14);
        const double angle = std::atan(t / std::sqrt(3.0));
        EXPECT_NEAR(student_t_coverage(t, 3),
                    2.0 / std::numbers::pi * (angle + std::sin(angle) * std::cos(angle)), 1e-14);
        const double cosine = std::cos(std::atan(t / 2.0));
        EXPECT_NEAR(student_t_coverage(t, 4),
                    std::sqrt(1.0 - cosine * cosine) * (1.0 + 0.5 * cosine * cosine), 1e-14);
    }
}

TEST(StudentT, QuantilesAreThoseOfPublishedTables) {
    // 97.5 % one-sided, Abramowitz and Stegun, table 26.10.
    EXPECT_NEAR(student_t_quantile(0.95, 1), 12.706, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.95, 2), 4.303, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.95, 4), 2.776, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.95, 9), 2.262, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.95, 30), 2.042, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.95, 120), 1.980, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.99, 4), 4.604, 5e-4);
}

}  // namespace
}  // namespace weft::student_t_test
