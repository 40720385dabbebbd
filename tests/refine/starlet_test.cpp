// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/starlet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace weft::starlet_test {
namespace {

Plane noise(std::uint32_t width, std::uint32_t height, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    Plane plane{width, height, std::vector<float>(std::size_t{width} * height)};
    for (float& value : plane.values) value = normal(random);
    return plane;
}

/// Cuts a line before one place in 20 or so.
std::vector<Run> cut(std::uint32_t size, std::mt19937& random) {
    std::bernoulli_distribution edge(0.05);
    std::vector<Run> runs;
    for (std::uint32_t begin = 0; begin < size;) {
        std::uint32_t end = begin + 1;
        while (end < size && !edge(random)) ++end;
        runs.insert(runs.end(), end - begin, {begin, end});
        begin = end;
    }
    return runs;
}

SurfaceRuns cut_at_random(std::uint32_t width, std::uint32_t height) {
    std::mt19937 random(width);
    SurfaceRuns runs(width, height);
    for (std::uint32_t y = 0; y < height; ++y) {
        const std::vector<Run> row = cut(width, random);
        std::copy(row.begin(), row.end(), runs.rows.begin() + y * width);
    }
    for (std::uint32_t x = 0; x < width; ++x) {
        const std::vector<Run> column = cut(height, random);
        for (std::uint32_t y = 0; y < height; ++y) runs.columns[y * width + x] = column[y];
    }
    return runs;
}

TEST(Starlet, DetailsAndWhatIsLeftAddUpToTheImage) {
    for (const auto& [width, height] :
         {std::pair{1U, 1U}, {1U, 9U}, {7U, 2U}, {40U, 33U}, {130U, 64U}}) {
        const Plane image = noise(width, height, width);
        Plane rest = image;
        std::vector<double> sum(image.values.size(), 0.0);
        const SurfaceRuns runs = cut_at_random(width, height);
        Plane* const coarse = &rest;
        for (std::uint32_t scale = 0; scale < starlet_scales(width, height); ++scale) {
            const Plane detail = take_details({&coarse, 1}, scale, runs).front();
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

TEST(Starlet, WhatIsTheSameInEachRunStays) {
    SurfaceRuns runs(96, 96);
    Plane halves{96, 96, std::vector<float>(96 * 96)};
    for (std::uint32_t y = 0; y < 96; ++y)
        for (std::uint32_t x = 0; x < 96; ++x) {
            const bool right = x + y >= 96;  // slanted, so that taps of rows and columns differ
            runs.rows[y * 96 + x] = right ? weft::Run{96 - y, 96} : weft::Run{0, 96 - y};
            runs.columns[y * 96 + x] = right ? weft::Run{96 - x, 96} : weft::Run{0, 96 - x};
            halves.values[y * 96 + x] = right ? 1e6F : 0.5F;
        }
    Plane* const planes[] = {&halves};
    for (const std::uint32_t step : {1U, 2U, 4U, 8U, 16U, 32U}) smooth(planes, step, runs);
    for (std::uint32_t y = 0; y < 96; ++y)
        for (std::uint32_t x = 0; x < 96; ++x)
            ASSERT_NEAR(halves.at(x, y), x + y >= 96 ? 1e6F : 0.5F, x + y >= 96 ? 2.0F : 1e-6F);
}

TEST(Starlet, SeveralPlanesAreSmoothedAsEachAlone) {
    const SurfaceRuns runs = cut_at_random(60, 50);
    Plane one = noise(60, 50, 1);
    Plane other = noise(60, 50, 2);
    Plane alone = other;
    Plane* const both[] = {&one, &other};
    Plane* const second[] = {&alone};
    for (const std::uint32_t step : {1U, 4U}) {
        smooth(both, step, runs);
        smooth(second, step, runs);
    }
    EXPECT_EQ(other.values, alone.values);
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
