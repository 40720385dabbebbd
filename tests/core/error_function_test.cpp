// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#define NATIVE_KERNELS "kernels/core/error_function.h"
#include "tests/testing/native_kernels.h"

namespace weft::error_function_test {
namespace {

TEST(ErrorFunction, IsThatOfTheStandardLibrary) {
    double worst = 0.0;
    for (int i = 0; i <= 400000; ++i) {
        const float x = -5.0F + static_cast<float>(i) * 2.5e-5F;
        const double exact = std::erf(static_cast<double>(x));
        const double error = std::abs(static_cast<double>(native::m_erf(x)) - exact);
        worst = std::max(worst, error / std::max(std::abs(exact), 1e-30));
    }
    // Two units in the last place, and the error of the fit.
    EXPECT_LT(worst, 3e-7);
    for (const float x : {1e-30F, 1e-10F, 0x1p-120F})
        EXPECT_NEAR(native::m_erf(x) / x, 1.1283791F, 3e-7F) << x;
    EXPECT_EQ(native::m_erf(0.0F), 0.0F);
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(native::m_erf(infinity), 1.0F);
    EXPECT_EQ(native::m_erf(-infinity), -1.0F);
    EXPECT_TRUE(std::isnan(native::m_erf(std::numeric_limits<float>::quiet_NaN())));
}

TEST(ErrorFunction, InverseGivesTheArgumentBack) {
    // By Newton's method from the inverse that is tested, which doubles correct digits in a step.
    double worst = 0.0;
    const auto check = [&](float x) {
        const auto found = static_cast<double>(native::m_erf_inverse(x));
        const double slope = std::exp(-found * found) * 1.1283791670955126;
        double exact = found;
        // erf is as good as 1 far out: there by its complement.
        exact += found > 0.0 ? (std::erfc(found) - (1.0 - static_cast<double>(x))) / slope
                             : ((1.0 + static_cast<double>(x)) - std::erfc(-found)) / slope;
        if (exact != 0.0) worst = std::max(worst, std::abs(found - exact) / std::abs(exact));
    };
    for (int i = 1; i < 200000; ++i) check(-1.0F + static_cast<float>(i) * 1e-5F);
    for (float far = 0x1p-24F; far < 0.01F; far *= 1.1F) {
        check(1.0F - far);
        check(-1.0F + far);
    }
    EXPECT_LT(worst, 2e-6);
    EXPECT_EQ(native::m_erf_inverse(0.0F), 0.0F);
    for (const float x : {1.0F, 2.0F, std::numeric_limits<float>::infinity()}) {
        EXPECT_NEAR(native::m_erf_inverse(x), 3.8325F, 1e-3F) << x;
        EXPECT_EQ(native::m_erf_inverse(-x), -native::m_erf_inverse(x));
    }
}

TEST(ErrorFunction, NeverFalls) {
    float before = -2.0F;
    float inverse_before = -10.0F;
    for (int i = 0; i <= 100000; ++i) {
        const float x = -4.5F + static_cast<float>(i) * 9e-5F;
        const float here = native::m_erf(x);
        // The polynomials waver by their errors.
        EXPECT_GE(here, before - 1.2e-7F) << x;
        before = here;
        const float inverse = native::m_erf_inverse(x / 4.5F);
        EXPECT_GE(inverse, inverse_before) << x;
        inverse_before = inverse;
    }
}

}  // namespace
}  // namespace weft::error_function_test
