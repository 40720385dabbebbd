// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/fourier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace weft::fourier_test {
namespace {

std::vector<Complex> random_values(std::size_t count) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<Complex> values(count);
    for (Complex& value : values) {
        const double real = uniform(generator);
        value = {real, uniform(generator)};
    }
    return values;
}

std::vector<Complex> slow_transform(const std::vector<Complex>& line, double sign) {
    const std::size_t n = line.size();
    std::vector<Complex> result(n);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j)
            result[k] += line[j] * std::polar(1.0, sign * 2.0 * std::numbers::pi *
                                                       static_cast<double>(j * k % n) /
                                                       static_cast<double>(n));
    return result;
}

double largest_difference(const std::vector<Complex>& a, const std::vector<Complex>& b) {
    EXPECT_EQ(a.size(), b.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

// Powers of two, other small factors, primes on both sides of the chirp's threshold, and products
// with a large prime.
class FourierLength : public testing::TestWithParam<std::size_t> {};

TEST_P(FourierLength, AgreesWithTheDefinition) {
    const std::vector<Complex> line = random_values(GetParam());
    LineTransform transform(GetParam());
    std::vector<Complex> result = line;
    transform.forward(result);
    EXPECT_LT(largest_difference(result, slow_transform(line, -1.0)), 1e-11);
    result = line;
    transform.inverse(result);
    EXPECT_LT(largest_difference(result, slow_transform(line, 1.0)), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Lengths, FourierLength,
                         testing::Values(1, 2, 3, 4, 5, 7, 8, 12, 27, 31, 37, 64, 97, 101, 120, 127,
                                         211, 256, 333, 517, 509, 1021));

TEST(Fourier, FindsAPlaneWaveWithItsSign) {
    constexpr std::uint32_t width = 20;
    constexpr std::uint32_t height = 14;
    std::vector<Complex> map(width * height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            map[y * width + x] =
                std::polar(1.0, 2.0 * std::numbers::pi * (3.0 * x / width - 5.0 * y / height));
    Fourier2d(width, height).forward(map);
    const std::size_t peak = (height - 5) * width + 3;
    for (std::size_t i = 0; i < map.size(); ++i)
        EXPECT_NEAR(std::abs(map[i] - (i == peak ? 280.0 : 0.0)), 0.0, 1e-11) << i;
}

TEST(Fourier, InverseUndoesForwardForAnySize) {
    constexpr std::uint32_t sizes[][2] = {{2, 2},     {1, 9},   {9, 1},    {64, 64},
                                          {127, 101}, {333, 7}, {96, 517}, {510, 3}};
    for (const auto& [width, height] : sizes) {
        const std::vector<Complex> map = random_values(std::size_t{width} * height);
        std::vector<Complex> result = map;
        Fourier2d fourier(width, height);
        fourier.forward(result);
        EXPECT_GT(largest_difference(result, map), 0.5);
        fourier.inverse(result);
        EXPECT_LT(largest_difference(result, map), 1e-13) << width << " x " << height;
    }
}

TEST(Fourier, LeavesOutColumnsBeyondTheReach) {
    for (const std::uint32_t width : {21u, 22u}) {
        constexpr std::uint32_t height = 12;
        for (const std::uint32_t reach : {0u, 1u, 9u, 10u, 11u}) {
            Fourier2d fourier(width, height);
            const std::vector<Complex> map = random_values(std::size_t{width} * height);
            std::vector<Complex> full = map;
            std::vector<Complex> part = map;
            fourier.forward(full);
            fourier.forward(part, reach);
            for (std::size_t i = 0; i < full.size(); ++i) {
                const std::size_t column = i % width;
                if (std::min(column, width - column) > reach)
                    full[i] = part[i] = 0.0;
                else
                    EXPECT_EQ(part[i], full[i]) << width << " " << reach << " " << i;
            }
            fourier.inverse(full);
            fourier.inverse(part, reach);
            EXPECT_LT(largest_difference(part, full), 1e-15) << width << " " << reach;
        }
    }
}

}  // namespace
}  // namespace weft::fourier_test
