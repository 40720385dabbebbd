// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/sample_noise.h"

#include <gtest/gtest.h>

#include <random>

namespace weft::sample_noise_test {
namespace {

constexpr std::uint32_t size = 96;
constexpr std::size_t pixels = std::size_t{size} * size;

Plane noise(float deviation, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(0.0F, deviation);
    Plane plane{size, size, std::vector<float>(pixels)};
    for (float& value : plane.values) value = normal(random);
    return plane;
}

double mean(const Plane& plane) {
    double sum = 0.0;
    for (const float value : plane.values) sum += static_cast<double>(value);
    return sum / pixels;
}

// The larger of a pixel's and its neighbourhood's is more than the variance, but not by far.
TEST(SampleNoise, TheVarianceIsThatOfTheMeanOfAllSamples) {
    for (const float first : {1.0F, 4.0F, 12.0F}) {  // of 16 samples of variance 16
        ExactHalves halves{{}, {}, first / 16.0F};
        for (std::uint32_t c = 0; c < 3; ++c) {
            halves.first[c] = noise(4.0F / std::sqrt(first), c);
            halves.second[c] = noise(4.0F / std::sqrt(16.0F - first), 10 + c);
        }
        const double variance = mean(sample_variance(halves));
        EXPECT_GT(variance, 3.0) << first;
        EXPECT_LT(variance, 5.0) << first;
    }
}

TEST(SampleNoise, EqualHalvesHaveNone) {
    const Plane plane = noise(1.0F, 1);
    const ExactHalves halves{{plane, plane, plane}, {plane, plane, plane}, 0.5F};
    for (const float variance : sample_variance(halves).values) ASSERT_EQ(variance, 0.0F);
}

TEST(SampleNoise, APixelThatHasNoneByChanceTakesThatAroundIt) {
    ExactHalves halves;
    for (std::uint32_t c = 0; c < 3; ++c) {
        halves.first[c] = noise(1.0F, c);
        halves.second[c] = noise(1.0F, 10 + c);
        halves.second[c].values[500] = halves.first[c].values[500];
    }
    EXPECT_GT(sample_variance(halves).values[500], 0.5F);
}

// About as much as there is, and at most four times, as long as runs are long for the scale.
TEST(SampleNoise, WhatIsLeftIsThatOfTheTransform) {
    for (const std::uint32_t length : {size, size / 2, size / 4, size / 8}) {
        SurfaceRuns runs(size, size);
        for (std::uint32_t y = 0; y < size; ++y)
            for (std::uint32_t x = 0; x < size; ++x) {
                const std::uint32_t column = x - x % length;
                const std::uint32_t row = y - y % length;
                runs.rows[std::size_t{y} * size + x] = {column, column + length};
                runs.columns[std::size_t{y} * size + x] = {row, row + length};
            }
        std::vector<double> power(starlet_scales(size, size) + 1, 0.0);
        constexpr std::uint32_t images = 30;
        for (std::uint32_t seed = 0; seed < images; ++seed) {
            Plane coarse = noise(1.0F, seed);
            const auto add = [&](const Plane& plane, std::size_t scale) {
                for (const float value : plane.values)
                    power[scale] += static_cast<double>(value * value) / (images * pixels);
            };
            Plane* const only = &coarse;
            for (std::uint32_t scale = 0; scale + 1 < power.size(); ++scale)
                add(take_details({&only, 1}, scale, runs).front(), scale);
            add(coarse, power.size() - 1);
        }
        for (std::uint32_t scale = 0; scale < power.size(); ++scale) {
            const double left = static_cast<double>(noise_left({0, length}, {0, length}, scale));
            EXPECT_GT(left, 0.8 * power[scale]) << length << " " << scale;
            if (length >= 8U << scale) {
                EXPECT_LT(left, 4.0 * power[scale]) << length << " " << scale;
            }
        }
    }
}

TEST(SampleNoise, FewProductsAgreeMoreByChance) {
    constexpr std::uint64_t many = 1'000'000;
    EXPECT_NEAR(chance_agreement({0, 512}, {0, 512}, 0, many), 0.212F, 0.001F);
    EXPECT_NEAR(chance_agreement({0, 512}, {0, 512}, 0, 2), 0.424F, 0.002F);
    EXPECT_NEAR(chance_agreement({0, 1}, {7, 8}, 3, many), 2.0F, 1e-4F);
    EXPECT_LT(chance_agreement({0, 512}, {0, 512}, 0, 8), chance_agreement({0, 8}, {0, 512}, 2, 8));
    EXPECT_LT(chance_agreement({0, 8}, {0, 512}, 2, 8), chance_agreement({0, 8}, {0, 8}, 2, 8));
}

}  // namespace
}  // namespace weft::sample_noise_test
