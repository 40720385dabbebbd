// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/half_errors/reference_halves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "base/error.h"

namespace weft::bench::reference_halves_test {
namespace {

constexpr std::uint32_t edge = 24;

/// An image of grey `level` with noise, the same in all channels of a pixel.
Image noisy(double level, double deviation, std::uint32_t seed, std::uint32_t width = edge) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal(level, deviation);
    Image image;
    image.width = width;
    image.height = edge;
    Layer layer;
    layer.channels = "RGB";
    const std::size_t pixels = std::size_t{width} * edge;
    layer.values.resize(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        layer.values[i] = layer.values[i + pixels] = layer.values[i + 2 * pixels] =
            static_cast<float>(deviation > 0.0 ? normal(generator) : level);
    image.layers.push_back(std::move(layer));
    return image;
}

TEST(ReferenceHalves, WithoutNoiseItIsRelmse) {
    const Image reference = noisy(2.0, 0.0, 0);
    const HalvesError error = halves_error(noisy(3.0, 0.0, 0), reference, reference, "x");
    EXPECT_NEAR(error.relmse, 1.0 / 4.04, 1e-9);
    EXPECT_EQ(error.interval, 0.0);
}

/// Errors of an even image against halves with so much noise about 1.
struct Runs {
    double mean = 0.0;
    double against_mean = 0.0;  ///< against the mean of the halves, as one reference
    double inside = 0.0;        ///< share of intervals that hold the true error
};

Runs measure(double level, double deviation) {
    constexpr std::uint32_t runs = 400;
    const Image image = noisy(level, 0.0, 0);
    const double truth = (level - 1.0) * (level - 1.0) / 1.01;
    Runs found;
    for (std::uint32_t run = 0; run < runs; ++run) {
        const Image first = noisy(1.0, deviation, 2 * run + 1);
        const Image second = noisy(1.0, deviation, 2 * run + 2);
        const HalvesError error = halves_error(image, first, second, "x");
        const Image middle = mean_of_halves(first, second, "x");
        found.mean += error.relmse / runs;
        found.against_mean += halves_error(image, middle, middle, "x").relmse / runs;
        found.inside += std::abs(error.relmse - truth) <= error.interval ? 1.0 / runs : 0.0;
    }
    return found;
}

TEST(ReferenceHalves, AlphaIsNoColour) {
    const Image reference = noisy(2.0, 0.0, 0);
    Image image = noisy(3.0, 0.0, 0);
    Layer& layer = image.layers.front();
    layer.channels = "RGBA";
    layer.values.resize(layer.values.size() / 3 * 4, 100.0F);
    EXPECT_NEAR(halves_error(image, reference, reference, "x").relmse, 1.0 / 4.04, 1e-9);
    EXPECT_EQ(mean_of_halves(image, image, "x").layers.front().values.size(),
              reference.layers.front().values.size());
}

TEST(ReferenceHalves, NoiseOfTheReferenceIsNoError) {
    const Runs right = measure(1.0, 0.03);
    EXPECT_NEAR(right.mean, 0.0, 1e-5);
    EXPECT_GT(right.against_mean, 4e-4);
    const Runs wrong = measure(1.1, 0.01);
    EXPECT_NEAR(wrong.mean, 0.0099, 5e-5);
}

TEST(ReferenceHalves, IntervalsHoldTheError) {
    for (const auto& [level, deviation] :
         {std::pair{1.0, 0.03}, std::pair{1.1, 0.01}, std::pair{1.0, 0.01}}) {
        const double inside = measure(level, deviation).inside;
        EXPECT_GT(inside, 0.87) << level << ' ' << deviation;
        EXPECT_LT(inside, 0.99) << level << ' ' << deviation;
    }
}

TEST(ReferenceHalves, OtherSizesAndNoColoursAreRefused) {
    const Image half = noisy(1.0, 0.0, 0);
    EXPECT_THROW(static_cast<void>(halves_error(noisy(1.0, 0.0, 0, 12), half, half, "x")), Error);
    EXPECT_THROW(static_cast<void>(mean_of_halves(half, noisy(1.0, 0.0, 0, 12), "x")), Error);
    Image depth = half;
    depth.layers.front().name = "depth";
    EXPECT_THROW(static_cast<void>(halves_error(depth, half, half, "x")), Error);
}

}  // namespace
}  // namespace weft::bench::reference_halves_test
