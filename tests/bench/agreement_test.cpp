// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace weft::bench::agreement_test {
namespace {

constexpr std::uint32_t edge = 32;

/// Images of noise about 1 in which all channels of a pixel are the same.
Images noise(std::uint32_t seed) {
    std::mt19937 generator(seed);
    std::exponential_distribution<float> light;
    Images images(6, std::vector<float>(std::size_t{3} * edge * edge));
    for (std::vector<float>& image : images)
        for (std::size_t i = 0; i < image.size() / 3; ++i)
            image[i] = image[i + edge * edge] = image[i + 2 * edge * edge] = light(generator);
    return images;
}

TEST(Agreement, LimitsAreThoseOfTheNormalDistribution) {
    EXPECT_NEAR(z_limit(1), 2.5758, 1e-4);
    EXPECT_NEAR(z_limit(10), 3.2905, 1e-4);
    EXPECT_EQ(block_count(32, 32), 16U);
    EXPECT_EQ(block_count(33, 8), 5U);
}

TEST(Agreement, NoiseAloneStaysBelowTheLimit) {
    const double limit = z_limit(block_count(edge, edge));
    int beyond = 0;
    double squares = 0.0;
    for (std::uint32_t run = 0; run < 100; ++run) {
        const Agreement found = compare_means(noise(2 * run), noise(2 * run + 1), edge, edge);
        beyond += found.worst_z > limit ? 1 : 0;
        squares += std::pow(found.difference / found.error, 2.0) / 100.0;
    }
    EXPECT_LE(beyond, 5);
    EXPECT_NEAR(squares, 1.0, 0.45);  // the errors are those that differences have
}

TEST(Agreement, ABlockThatIsBrighterIsSeen) {
    const Images first = noise(1);
    Images second = noise(2);
    for (std::vector<float>& image : second)
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t y = 8; y < 16; ++y)
                for (std::size_t x = 24; x < 32; ++x)
                    image[(channel * edge + y) * edge + x] *= 1.6F;
    const Agreement found = compare_means(first, second, edge, edge);
    EXPECT_GT(found.worst_z, z_limit(block_count(edge, edge)));
    EXPECT_LT(std::abs(found.difference), 0.1);
}

TEST(Agreement, WhatHasNoNoiseMayDifferByRounding) {
    const Images first(3, std::vector<float>(std::size_t{3} * edge * edge, 1.0F));
    Images second = first;
    for (std::vector<float>& image : second) image[5] = 1.0001F;
    EXPECT_EQ(compare_means(first, second, edge, edge).worst_z, 0.0);
    for (std::vector<float>& image : second) image[5] = 1.1F;
    EXPECT_TRUE(std::isinf(compare_means(first, second, edge, edge).worst_z));
}

}  // namespace
}  // namespace weft::bench::agreement_test
