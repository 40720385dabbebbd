// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#define NATIVE_KERNELS "kernels/core/wide_maths.h"
#include "tests/testing/native_kernels.h"

namespace {

using namespace native;

/// Distance of floats about `exact`, which is 0 or more.
double unit_at(double exact) {
    // Below the smallest normal float they are evenly apart; ilogb(0) is no exponent.
    const double normal = static_cast<double>(std::numeric_limits<float>::min());
    return std::ldexp(1.0, std::ilogb(std::max(exact, normal)) - 23);
}

std::array<float, LANES> exp_minus(const std::array<float, LANES>& depths) {
    std::array<float, LANES> results{};
    wide_store(wide_exp_minus(wide_load(depths.data(), 0)), results.data(), 0);
    return results;
}

float exp_minus(float depth) {
    std::array<float, LANES> depths{};
    depths.fill(depth);
    return exp_minus(depths)[LANES - 1];
}

TEST(WideMaths, ExponentialIsCorrectToOneUlp) {
    double worst = 0.0;
    std::array<float, LANES> depths{};
    for (int step = 0; step < 400000; step += LANES) {
        for (std::size_t lane = 0; lane < LANES; ++lane) {
            const float at = static_cast<float>(step + static_cast<int>(lane)) / 400000.0F;
            // Half evenly in the depth, half in its logarithm from 2^-40 on.
            depths[lane] = (step + static_cast<int>(lane)) % 2 == 0 ? at * 104.0F
                                                                    : std::exp2(at * 46.0F - 40.0F);
        }
        const std::array<float, LANES> results = exp_minus(depths);
        for (std::size_t lane = 0; lane < LANES; ++lane) {
            const double exact = std::exp(-static_cast<double>(depths[lane]));
            worst = std::max(worst,
                             std::abs(static_cast<double>(results[lane]) - exact) / unit_at(exact));
        }
    }
    EXPECT_LT(worst, 1.0);
    EXPECT_GT(worst, 0.4);
}

TEST(WideMaths, ExponentialAtTheEnds) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(exp_minus(0.0F), 1.0F);
    EXPECT_EQ(exp_minus(std::numeric_limits<float>::denorm_min()), 1.0F);
    EXPECT_EQ(exp_minus(104.0F), 0.0F);
    EXPECT_EQ(exp_minus(std::numeric_limits<float>::max()), 0.0F);
    EXPECT_EQ(exp_minus(infinity), 0.0F);
    EXPECT_EQ(exp_minus(std::numeric_limits<float>::quiet_NaN()), 0.0F);
    EXPECT_EQ(exp_minus(103.0F), std::exp(-103.0F));
    for (float depth = 0.0F; depth < 100.0F; depth += 0.37F)
        EXPECT_LE(exp_minus(std::nextafter(depth, infinity)), exp_minus(depth)) << depth;
}

float upper_angle(float y, float x) {
    std::array<float, LANES> results{};
    wide_store(wide_upper_angle(WIDE(y), WIDE(x)), results.data(), 0);
    return results[LANES - 1];
}

TEST(WideMaths, UpperAngleIsCorrectToThreeUlp) {
    double worst = 0.0;
    for (int step = 0; step <= 200000; ++step) {
        const double turn = static_cast<double>(step) / 200000.0;
        // Evenly all around, and close to both ends.
        for (const double angle :
             {turn * 3.14159, std::exp2(-40.0 * turn), 3.14159265 - std::exp2(-20.0 * turn)}) {
            const auto y = static_cast<float>(3.7 * std::sin(angle));
            const auto x = static_cast<float>(3.7 * std::cos(angle));
            if (y < 0.0F) continue;
            const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
            worst = std::max(
                worst, std::abs(static_cast<double>(upper_angle(y, x)) - exact) / unit_at(exact));
        }
    }
    EXPECT_LT(worst, 3.0);
    EXPECT_GT(worst, 0.4);
}

TEST(WideMaths, UpperAngleOnTheAxes) {
    EXPECT_EQ(upper_angle(0.0F, 0.0F), 0.0F);
    EXPECT_EQ(upper_angle(0.0F, 2.0F), 0.0F);
    EXPECT_EQ(upper_angle(2.0F, 0.0F), static_cast<float>(std::atan2(1.0, 0.0)));
    EXPECT_EQ(upper_angle(0.0F, -2.0F), static_cast<float>(std::atan2(0.0, -1.0)));
}

}  // namespace
