// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/starlet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace weft::starlet_test {
namespace {

Plane noise(std::uint32_t width, std::uint32_t height, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    Plane plane{width, height, std::vector<float>(std::size_t{width} * height)};
    for (float& value : plane.values) value = normal(random);
    return plane;
}

TEST(Starlet, DetailsAndWhatIsLeftAddUpToTheImage) {
    for (const auto& [width, height] :
         {std::pair{1U, 1U}, {1U, 9U}, {7U, 2U}, {40U, 33U}, {130U, 64U}}) {
        const Plane image = noise(width, height, width);
        Plane rest = image;
        std::vector<double> sum(image.values.size(), 0.0);
        for (std::uint32_t scale = 0; scale < starlet_scales(width, height); ++scale) {
            const Plane detail = take_detail(rest, scale);
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += static_cast<double>(detail.values[i]);
        }
        for (std::size_t i = 0; i < sum.size(); ++i)
            EXPECT_NEAR(sum[i] + static_cast<double>(rest.values[i]),
                        static_cast<double>(image.values[i]), 4e-6);
    }
}

TEST(Starlet, APointBecomesTheSpline) {
    constexpr std::array<float, 5> taps{1.0F / 16, 4.0F / 16, 6.0F / 16, 4.0F / 16, 1.0F / 16};
    constexpr std::int32_t middle = 20;
    for (const std::uint32_t step : {1U, 2U, 4U}) {
        Plane point{41, 41, std::vector<float>(41 * 41, 0.0F)};
        point.values[middle * 41 + middle] = 1.0F;
        const Plane spread = smoothed(point, step);
        const auto tap = [&](std::int32_t offset) {
            const auto s = static_cast<std::int32_t>(step);
            if (offset % s != 0 || std::abs(offset / s) > 2) return 0.0F;
            return taps[static_cast<std::size_t>(offset / s + 2)];
        };
        for (std::int32_t y = 0; y < 41; ++y)
            for (std::int32_t x = 0; x < 41; ++x)
                EXPECT_EQ(spread.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)),
                          tap(x - middle) * tap(y - middle));
    }
}

TEST(Starlet, WhatIsTheSameEverywhereStays) {
    const Plane flat{33, 18, std::vector<float>(33 * 18, 0.7F)};
    for (const std::uint32_t step : {1U, 8U, 64U})
        for (const float value : smoothed(flat, step).values) EXPECT_NEAR(value, 0.7F, 2e-7F);
}

TEST(Starlet, AMirroredImageIsSmoothedAlike) {
    const Plane image = noise(37, 21, 5);
    Plane mirrored = image;
    for (std::uint32_t y = 0; y < 21; ++y)
        std::reverse(mirrored.values.begin() + y * 37, mirrored.values.begin() + (y + 1) * 37);
    for (const std::uint32_t step : {1U, 4U, 32U}) {
        const Plane one = smoothed(image, step);
        const Plane other = smoothed(mirrored, step);
        for (std::uint32_t y = 0; y < 21; ++y)
            for (std::uint32_t x = 0; x < 37; ++x) EXPECT_EQ(one.at(x, y), other.at(36 - x, y));
    }
}

TEST(Starlet, ScalesEndWhereDetailsAreAsWideAsTheImage) {
    EXPECT_EQ(starlet_scales(1, 1), 1U);
    EXPECT_EQ(starlet_scales(15, 1000), 1U);
    EXPECT_EQ(starlet_scales(16, 1000), 2U);
    EXPECT_EQ(starlet_scales(512, 512), 7U);
    EXPECT_EQ(starlet_scales(1U << 16, 1U << 16), 8U);
}

}  // namespace
}  // namespace weft::starlet_test
