// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/image_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "bench/path/ratio.h"

namespace weft::bench::image_noise_test {
namespace {

/// Images of independent normal deviates about a mean.
Images noise(std::size_t count, std::size_t size, double mean, double deviation,
             std::uint32_t seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal(mean, deviation);
    Images images(count, std::vector<float>(size));
    for (std::vector<float>& image : images)
        for (float& value : image) value = static_cast<float>(normal(generator));
    return images;
}

TEST(ImageNoise, MomentsAreThoseOfTheValues) {
    const Moments found = moments({{1.0F, 5.0F}, {2.0F, 5.0F}, {6.0F, 5.0F}});
    EXPECT_DOUBLE_EQ(found.mean[0], 3.0);
    EXPECT_DOUBLE_EQ(found.variance[0], 7.0);  // (4 + 1 + 9) / 2
    EXPECT_DOUBLE_EQ(found.mean[1], 5.0);
    EXPECT_DOUBLE_EQ(found.variance[1], 0.0);
}

TEST(ImageNoise, TheScaleHasAFloorFromTheImageAndNoUnit) {
    const std::vector<double> scale = noise_scale({{0.0, 4.0}, {0.0, 8.0}});
    EXPECT_DOUBLE_EQ(scale[0], 0.09);  // the image's mean is 3
    EXPECT_DOUBLE_EQ(scale[1], 36.09);
    const std::vector<double> darker = noise_scale({{0.0, 4e-6}, {0.0, 8e-6}});
    EXPECT_NEAR(darker[0], 0.09e-12, 1e-24);
}

TEST(ImageNoise, VarianceIsUnbiasedWhateverTheNumberOfImages) {
    const std::vector<double> scale(20000, 4.0);
    for (const std::size_t count : {3U, 5U, 20U}) {
        const Ratio found = relative_variance(noise(count, 20000, 2.0, 0.5, 7), scale);
        EXPECT_NEAR(found.value, 0.0625, 0.0625 * 0.03) << count;
    }
}

TEST(ImageNoise, TheSpreadIsThatOfManyRuns) {
    const std::vector<double> scale(50, 1.0);
    std::vector<double> values;
    double spread = 0.0;
    constexpr int runs = 400;
    for (std::uint32_t run = 0; run < runs; ++run) {
        const Ratio found = relative_variance(noise(8, 50, 1.0, 0.3, run), scale);
        values.push_back(std::log(found.value));
        spread += found.spread * found.spread / runs;
    }
    double mean = 0.0;
    double squares = 0.0;
    for (const double value : values) mean += value / runs;
    for (const double value : values) squares += (value - mean) * (value - mean) / (runs - 1);
    EXPECT_NEAR(std::sqrt(spread) / std::sqrt(squares), 1.0, 0.25);
}

TEST(ImageNoise, RatiosMultiplyAndTheirErrorsAddUp) {
    const Ratio product = Ratio{2.0, 0.03} * Ratio{5.0, 0.04};
    EXPECT_DOUBLE_EQ(product.value, 10.0);
    EXPECT_DOUBLE_EQ(product.spread, 0.05);
    EXPECT_DOUBLE_EQ((Ratio{2.0, 0.03} / Ratio{5.0, 0.04}).value, 0.4);
    const Ratio mean = geometric_mean({{2.0, 0.1}, {8.0, 0.1}});
    EXPECT_DOUBLE_EQ(mean.value, 4.0);
    EXPECT_NEAR(mean.spread, 0.1 / std::sqrt(2.0), 1e-12);
}

TEST(ImageNoise, ADisturbedRunMovesNoRatioOfTimes) {
    const std::vector<double> theirs{20.0, 21.0, 19.0, 20.5, 20.0};
    const std::vector<double> calm{10.0, 10.5, 9.5, 10.25, 10.0};
    EXPECT_DOUBLE_EQ(paired_ratio(theirs, calm).value, 2.0);
    EXPECT_DOUBLE_EQ(paired_ratio(theirs, calm).spread, 0.0);
    const Ratio disturbed = paired_ratio(theirs, {10.0, 10.5, 95.0, 10.25, 9.0});
    EXPECT_NEAR(disturbed.value, 2.0, 1e-12);
}

}  // namespace
}  // namespace weft::bench::image_noise_test
