// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "adaptive/level_scheduler.h"

// The error that the scheduler expects of interpolation, against what is known of simple signals.
namespace weft::interpolation_errors_test {
namespace {

constexpr std::uint32_t columns = 13;
constexpr std::uint32_t rows = 11;
constexpr double luminance_scale = 100.0;
constexpr std::uint32_t all_neighbours = 0xFF;

/// Share of a second difference of the 3 x 3 means that counts as error: an eighth by
/// interpolation, a third by the mean itself.
constexpr double curvature_share = 1.0 / 8.0 + 1.0 / 3.0;

using Signal = std::function<double(double x, double y)>;

/// A lattice that is one surface, every point sampled.
std::vector<shared::float4> lattice(const Signal& irradiance, double reflectance,
                                    double other = 0.0) {
    std::vector<shared::float4> points;
    for (int y = 0; y < static_cast<int>(rows); ++y)
        for (int x = 0; x < static_cast<int>(columns); ++x) {
            std::uint32_t bits = LATTICE_SAMPLED;
            std::uint32_t bit = 1;
            for (int v = y - 1; v <= y + 1; ++v)
                for (int u = x - 1; u <= x + 1; ++u) {
                    if (u == x && v == y) continue;
                    if (u >= 0 && v >= 0 && u < static_cast<int>(columns) &&
                        v < static_cast<int>(rows))
                        bits |= bit;
                    bit <<= 1;
                }
            points.push_back({static_cast<float>(irradiance(x, y)), static_cast<float>(reflectance),
                              static_cast<float>(other), static_cast<float>(bits)});
        }
    return points;
}

std::vector<float> errors_of(const std::vector<shared::float4>& points) {
    return interpolation_errors(columns, rows, points, BrightnessSlope(luminance_scale));
}

double at(const std::vector<float>& errors, std::uint32_t x, std::uint32_t y) {
    return static_cast<double>(errors[y * columns + x]);
}

/// Just noticeable differences of a difference of irradiance where the mean is `mean`.
double visible(double difference, double reflectance, double mean, double other = 0.0) {
    const BrightnessSlope slope(luminance_scale);
    return difference * reflectance *
           static_cast<double>(slope(static_cast<float>(reflectance * mean + other)));
}

/// Calls use(x, y) for points whose means, and those of their neighbours, have nine points.
void for_inner(const std::function<void(std::uint32_t x, std::uint32_t y)>& use) {
    for (std::uint32_t y = 2; y + 2 < rows; ++y)
        for (std::uint32_t x = 2; x + 2 < columns; ++x) use(x, y);
}

TEST(InterpolationErrors, ConstantsHaveNone) {
    for (const double value : {0.0, 1.0, 3.7, 1e4})
        for (const float error : errors_of(lattice([&](double, double) { return value; }, 0.3)))
            EXPECT_NEAR(error, 0.0F, visible(1e-6 * value, 0.3, value) + 1e-30);
}

TEST(InterpolationErrors, RampsHaveNoneButAtTheBorder) {
    const double a = 0.25;
    const double b = -0.125;
    const auto errors =
        errors_of(lattice([&](double x, double y) { return 5.0 + a * x + b * y; }, 0.3));
    for_inner([&](auto x, auto y) {
        EXPECT_NEAR(at(errors, x, y), 0.0, visible(1e-5, 0.3, 5.0)) << x << ' ' << y;
    });
    // In the first column the mean of two columns stands beside that of three: a quarter of the
    // step between them, half of the ramp's, is the error. Other means there are 0 apart along y.
    EXPECT_NEAR(at(errors, 0, 5), visible(0.25 * 0.5 * a, 0.3, 5.0 + 0.5 * a + 5.0 * b), 1e-3);
    EXPECT_GT(at(errors, 0, 5), 0.01);
}

TEST(InterpolationErrors, SecondDifferencesAddOverTheAxes) {
    const double a = 0.02;
    const double b = -0.05;
    const Signal bowl = [&](double x, double y) { return 10.0 + a * x * x + b * y * y; };
    const auto errors = errors_of(lattice(bowl, 0.4));
    for_inner([&](auto x, auto y) {
        // Means of squares are those of the middle and 2/3.
        const double mean = bowl(x, y) + 2.0 / 3.0 * (a + b);
        const double expected =
            visible(curvature_share * 2.0 * (std::abs(a) + std::abs(b)), 0.4, mean);
        // The share is rounded to 0.458, and the slope's table may part two close means.
        EXPECT_NEAR(at(errors, x, y), expected, 2e-3 * expected) << x << ' ' << y;
    });
}

TEST(InterpolationErrors, ScaleWithReflectanceAndHideBehindOtherLight) {
    const Signal wave = [](double x, double y) { return 2.0 + std::sin(x) + std::cos(0.7 * y); };
    const auto dim = errors_of(lattice(wave, 0.1));
    const auto beside = errors_of(lattice(wave, 0.1, 50.0));
    const auto bright = errors_of(lattice(wave, 0.2));
    const auto black = errors_of(lattice(wave, 0.0));
    for_inner([&](auto x, auto y) {
        if (at(dim, x, y) == 0.0) return;
        // Twice the radiance, but at twice the luminance, where the eye is less keen.
        EXPECT_GT(at(bright, x, y), at(dim, x, y)) << x << ' ' << y;
        EXPECT_LT(at(bright, x, y), 2.0 * at(dim, x, y)) << x << ' ' << y;
        EXPECT_LT(at(beside, x, y), 0.1 * at(dim, x, y)) << x << ' ' << y;
        EXPECT_EQ(at(black, x, y), 0.0);
    });
    EXPECT_GT(at(dim, 5, 5), 0.0);
}

TEST(InterpolationErrors, OnlyNeighboursOnTheSurfaceCount) {
    // A spike that none of its neighbours counts as one of its surface stays alone.
    auto points = lattice([](double, double) { return 1.0; }, 0.3);
    constexpr std::uint32_t x = 6;
    constexpr std::uint32_t y = 5;
    points[y * columns + x].x = 1e6F;
    EXPECT_GT(at(errors_of(points), x - 1, y), 1.0);
    for (std::uint32_t v = y - 1; v <= y + 1; ++v)
        for (std::uint32_t u = x - 1; u <= x + 1; ++u) {
            shared::float4& point = points[v * columns + u];
            auto bits = static_cast<std::uint32_t>(point.w);
            if (u == x && v == y) {
                bits &= ~all_neighbours;
            } else {
                // Which of its bits is the spike: the neighbours without the middle, row by row.
                const std::uint32_t place = 3 * (y + 1 - v) + (x + 1 - u);
                bits &= ~(1U << (place > 4 ? place - 1 : place));
            }
            point.w = static_cast<float>(bits);
        }
    for (const float error : errors_of(points)) EXPECT_NEAR(error, 0.0F, 1e-4F);
}

TEST(InterpolationErrors, PointsWithoutSamplesHaveNone) {
    auto points = lattice([](double x, double) { return x * x; }, 0.3);
    ASSERT_GT(at(errors_of(points), 6, 5), 0.0);
    points[5 * columns + 6] = {0.0F, 0.0F, 0.0F, 0.0F};
    EXPECT_EQ(at(errors_of(points), 6, 5), 0.0);
}

TEST(InterpolationErrors, WhatIsNotFiniteIsNoNumberOrInfinite) {
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        auto points = lattice([](double, double) { return 1.0; }, 0.3);
        points[5 * columns + 6].x = value;
        const auto errors = errors_of(points);
        for (std::uint32_t y = 0; y < rows; ++y)
            for (std::uint32_t x = 0; x < columns; ++x) {
                // Its own mean and those beside it.
                if (x >= 5 && x <= 7 && y >= 4 && y <= 6) {
                    EXPECT_FALSE(std::isfinite(at(errors, x, y))) << x << ' ' << y;
                } else if (x < 4 || x > 8 || y < 3 || y > 7) {
                    EXPECT_NEAR(at(errors, x, y), 0.0, 1e-4) << x << ' ' << y;
                }
            }
    }
}

}  // namespace
}  // namespace weft::interpolation_errors_test
