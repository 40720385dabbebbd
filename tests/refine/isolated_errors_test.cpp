// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/isolated_errors.h"

#include <gtest/gtest.h>

#include <random>

#include "refine/sample_noise.h"

namespace weft::isolated_errors_test {
namespace {

constexpr std::uint32_t size = 32;
constexpr std::size_t pixels = std::size_t{size} * size;
constexpr std::size_t speck = 16 * size + 16;

ColourPlanes planes_of(float value) {
    ColourPlanes planes;
    for (Plane& plane : planes) plane = {size, size, std::vector<float>(pixels, value)};
    return planes;
}

ColourPlanes noisy(float value, float noise, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(value, noise);
    ColourPlanes planes = planes_of(0.0F);
    for (Plane& plane : planes)
        for (float& found : plane.values) found = normal(random);
    return planes;
}

ColourPlanes correct(ExactHalves& halves) {
    ColourPlanes image = planes_of(0.0F);
    correct_isolated(halves, sample_variance(halves), SurfaceRuns(size, size), image);
    return image;
}

TEST(IsolatedErrors, ASpeckOfThePreviewIsCorrectedInItsPixelAlone) {
    ExactHalves halves{noisy(0.0F, 0.1F, 1), noisy(0.0F, 0.1F, 2), 0.5F};
    for (std::size_t c = 0; c < 3; ++c) {
        halves.first[c].values[speck] -= 200.0F;
        halves.second[c].values[speck] -= 200.0F;
    }
    const ColourPlanes image = correct(halves);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(image[c].values[speck], -200.0F, 2.0F);
        EXPECT_LT(std::abs(halves.first[c].values[speck]), 2.0F);
        EXPECT_LT(std::abs(halves.second[c].values[speck]), 2.0F);
        for (std::size_t i = 0; i < pixels; ++i) {
            if (i == speck) continue;
            ASSERT_EQ(image[c].values[i], 0.0F) << i;
        }
    }
}

TEST(IsolatedErrors, WhatOneHalfHasAloneStays) {
    ExactHalves halves{noisy(0.0F, 0.1F, 1), noisy(0.0F, 0.1F, 2), 0.5F};
    halves.first[1].values[speck] = 200.0F;
    const ColourPlanes image = correct(halves);
    EXPECT_EQ(image[1].values[speck], 0.0F);
    EXPECT_EQ(halves.first[1].values[speck], 200.0F);
}

// Where samples are now and then as bright, both halves are so in a pixel by chance.
TEST(IsolatedErrors, WhatMayBeChanceIsLeftOut) {
    ExactHalves halves{noisy(0.0F, 0.1F, 5), noisy(0.0F, 0.1F, 6), 0.5F};
    halves.first[1].values[speck] = halves.second[1].values[speck] = 200.0F;
    halves.first[1].values[speck + 5 * size] = 250.0F;
    const ColourPlanes image = correct(halves);
    EXPECT_EQ(image[1].values[speck], 0.0F);
    EXPECT_LT(halves.first[1].values[speck], 2.0F) << "nor do its neighbours get a part of it";
}

TEST(IsolatedErrors, ABrightSpeckOfThePreviewIsCorrectedAmongBrightSamples) {
    ExactHalves halves{noisy(0.0F, 0.1F, 7), noisy(0.0F, 0.1F, 8), 0.5F};
    ColourPlanes image = planes_of(1.0F);
    for (std::size_t c = 0; c < 3; ++c) {
        image[c].values[speck] = 200.0F;
        halves.first[c].values[speck] = halves.second[c].values[speck] = -199.0F;
        halves.first[c].values[speck + 5 * size] = 250.0F;
    }
    correct_isolated(halves, sample_variance(halves), SurfaceRuns(size, size), image);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(image[c].values[speck], 1.0F, 2.0F);
}

TEST(IsolatedErrors, WideErrorsAndNoiseStay) {
    for (const float error : {0.0F, 0.05F, 10.0F}) {
        ExactHalves halves{noisy(error, 0.1F, 3), noisy(error, 0.1F, 4), 0.5F};
        const ColourPlanes image = correct(halves);
        for (const Plane& plane : image)
            for (const float value : plane.values) ASSERT_EQ(value, 0.0F) << error;
    }
}

}  // namespace
}  // namespace weft::isolated_errors_test
