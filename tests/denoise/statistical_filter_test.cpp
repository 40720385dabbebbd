// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/statistical_filter.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/testing/noisy_image.h"

namespace weft::statistical_filter_test {
namespace {

using test::dark_wall;
using test::shine;
using test::values_of;

constexpr std::uint64_t samples = 1000;
constexpr DenoiseView view{.orthographic = false, .pixel = 0.01, .media = false};
constexpr float albedo = 0.5F;

const auto even = [](std::size_t, std::size_t) { return 1.0; };

/// Sum of squared weights of a window over the square of their sum: the share of the variance that
/// is left where every pixel of it counts.
double share_left() {
    double sum = 0.0;
    double squares = 0.0;
    for (int y = -7; y <= 7; ++y)
        for (int x = -7; x <= 7; ++x) {
            const double weight = std::exp(-(x * x + y * y) / 18.0);
            sum += weight;
            squares += weight * weight;
        }
    return squares / (sum * sum);
}

struct Moments {
    double mean = 0.0;
    double variance = 0.0;
};

/// Of the red light of pixels farther than a window from the border.
Moments moments_inside(const std::vector<float>& colours, std::uint32_t width,
                       std::uint32_t height) {
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t y = 8; y + 8 < height; ++y)
        for (std::size_t x = 8; x + 8 < width; ++x) {
            const double light = colours[y * width + x] / double{albedo};
            count += 1.0;
            sum += light;
            squares += light * light;
        }
    const double mean = sum / count;
    return {mean, squares / count - mean * mean};
}

TEST(StatisticalFilter, EvenLightLosesAsMuchNoiseAsItsWindowHasPixels) {
    constexpr std::uint32_t edge = 256;
    constexpr double deviation = 0.1;
    Image wall = dark_wall(edge, edge);
    shine(wall, even, deviation, 1);
    const Moments before = moments_inside(values_of(wall, ""), edge, edge);
    const Moments after = moments_inside(statistical_filter(wall, samples, view), edge, edge);
    // 240 x 240 pixels hold about 500 windows, whose variance is known to 6 % or so: five of these.
    // Of the pixels of a window, some 5 % are told apart by one of the tests, and the more so the
    // farther a pixel is off: half a percent of the pixels keep much of their noise.
    EXPECT_GT(after.variance, 0.7 * share_left() * deviation * deviation);
    EXPECT_LT(after.variance, 2.0 * share_left() * deviation * deviation);
    // The mean of so many pixels is known to deviation / 240.
    EXPECT_NEAR(after.mean, before.mean, 5.0 * deviation / 240.0);
}

TEST(StatisticalFilter, AnEdgeFarAboveTheNoiseStays) {
    constexpr std::uint32_t edge = 64;
    constexpr double deviation = 0.02;
    Image wall = dark_wall(edge, edge);
    const auto step = [](std::size_t x, std::size_t) { return x < 32 ? 1.0 : 2.0; };
    shine(wall, step, deviation, 2);
    const std::vector<float> result = statistical_filter(wall, samples, view);
    double squares = 0.0;
    for (std::size_t i = 0; i < std::size_t{edge} * edge; ++i) {
        const double off = result[i] / double{albedo} - step(i % edge, 0);
        EXPECT_LT(std::abs(off), 5.0 * deviation) << i;
        if (i % edge == 31 || i % edge == 32) squares += off * off;
    }
    // Beside the edge windows have half of their pixels, and still average.
    EXPECT_LT(squares / (2.0 * edge), 0.2 * deviation * deviation);
}

TEST(StatisticalFilter, WithoutVarianceNothingChanges) {
    for (const bool varied : {false, true}) {
        Image wall = dark_wall(40, 30);
        shine(
            wall,
            [&](std::size_t x, std::size_t y) {
                return varied ? 1.0 + 0.001 * static_cast<double>(x * y) : 0.3;
            },
            0.0, 3);
        EXPECT_EQ(statistical_filter(wall, samples, view), values_of(wall, ""));
    }
}

TEST(StatisticalFilter, EqualLightStaysBitForBitWhateverItsVariance) {
    Image wall = dark_wall(40, 30);
    shine(
        wall, [](std::size_t, std::size_t) { return 0.7; }, 0.0, 4);
    for (float& value : values_of(wall, "variance")) value = 0.09F;
    EXPECT_EQ(statistical_filter(wall, samples, view), values_of(wall, ""));
}

TEST(StatisticalFilter, OtherSurfacesHaveNoPart) {
    constexpr std::uint32_t edge = 64;
    constexpr double deviation = 0.1;
    // Too little to be told apart from noise.
    const auto step = [](std::size_t x, std::size_t) { return x < 32 ? 1.0 : 1.1; };
    /// Mean light of the two columns at the step, over the left one's and the right one's.
    const auto means = [&](Image& wall) {
        const std::vector<float> result = statistical_filter(wall, samples, view);
        double left = 0.0;
        double right = 0.0;
        for (std::size_t y = 0; y < edge; ++y) {
            left += result[y * edge + 31] / (albedo * double{edge});
            right += result[y * edge + 32] / (albedo * double{edge});
        }
        return std::pair(left, right);
    };
    // Each is a mean over 64 x 7 pixels or more: 0.1 / sqrt(448) is 0.005.
    constexpr double tolerance = 0.02;
    Image one = dark_wall(edge, edge);
    shine(one, step, deviation, 5);
    EXPECT_NEAR(means(one).second - means(one).first, 0.0, 0.05);
    Image nearer = one;
    Image turned = one;
    for (std::size_t i = 0; i < std::size_t{edge} * edge; ++i) {
        if (i % edge < 32) continue;
        values_of(nearer, "depth")[i] = 2.2F;
        values_of(turned, "normal")[2 * edge * edge + i] = 0.0F;
        values_of(turned, "normal")[i] = 1.0F;
    }
    for (Image* const image : {&nearer, &turned}) {
        EXPECT_NEAR(means(*image).first, 1.0, tolerance);
        EXPECT_NEAR(means(*image).second, 1.1, tolerance);
    }
}

TEST(StatisticalFilter, ASlopingPlaneIsOneSurface) {
    constexpr std::uint32_t edge = 64;
    constexpr double deviation = 0.1;
    for (const bool orthographic : {false, true}) {
        Image floor = dark_wall(edge, edge);
        for (std::size_t i = 0; i < std::size_t{edge} * edge; ++i) {
            const auto row = static_cast<double>(i / edge);
            values_of(floor, "depth")[i] =
                static_cast<float>(orthographic ? 1.0 + row : 1.0 / (1.0 - 0.015 * row));
        }
        shine(floor, even, deviation, 6);
        const Moments after = moments_inside(
            statistical_filter(floor, samples, {orthographic, 0.01, false}), edge, edge);
        EXPECT_LT(after.variance, 0.03 * deviation * deviation) << orthographic;
    }
}

TEST(StatisticalFilter, TexturesStay) {
    constexpr std::uint32_t edge = 64;
    constexpr double deviation = 0.1;
    Image wall = dark_wall(edge, edge);
    std::vector<float>& painted = values_of(wall, "albedo");
    for (std::size_t at = 0; at < painted.size(); ++at)
        painted[at] = (at + at / edge) % 2 == 0 ? 0.8F : 0.1F;
    shine(wall, even, deviation, 7);
    const std::vector<float> result = statistical_filter(wall, samples, view);
    for (std::size_t y = 8; y + 8 < edge; ++y)
        for (std::size_t x = 8; x + 8 < edge; ++x) {
            const std::size_t at = y * edge + x;
            EXPECT_NEAR(result[at] / painted[at], 1.0, 4.0 * deviation);
        }
    // Where something adds light, it cannot be divided by albedo: then only like ones share it.
    const DenoiseView foggy{false, 0.01, true};
    const std::vector<float> in_fog = statistical_filter(wall, samples, foggy);
    for (std::size_t at = 0; at < in_fog.size(); ++at)
        EXPECT_NEAR(in_fog[at] / painted[at], 1.0, 4.0 * deviation);
}

TEST(StatisticalFilter, AChannelWithoutAlbedoNeitherGivesNorTakes) {
    constexpr std::uint32_t edge = 32;
    constexpr std::size_t pixels = std::size_t{edge} * edge;
    Image wall = dark_wall(edge, edge);
    // Stripes that reflect no green.
    for (std::size_t i = 0; i < pixels; ++i)
        if (i % 3 == 0) values_of(wall, "albedo")[pixels + i] = 0.0F;
    shine(wall, even, 0.1, 8);
    const std::vector<float> result = statistical_filter(wall, samples, view);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float green = result[pixels + i];
        if (i % 3 == 0)
            EXPECT_EQ(green, 0.0F);
        else
            EXPECT_NEAR(green / albedo, 1.0, 0.2);
        EXPECT_NEAR(result[i] / albedo, 1.0, 0.2);
    }
}

TEST(StatisticalFilter, LightSourcesAndBackgroundStayAndHaveNoPart) {
    constexpr std::uint32_t edge = 32;
    constexpr std::size_t pixels = std::size_t{edge} * edge;
    Image wall = dark_wall(edge, edge);
    shine(wall, even, 0.1, 9);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::size_t x = i % edge;
        if (x >= 20) continue;
        for (std::size_t at = i; at < 3 * pixels; at += pixels) {
            // A lamp, then a background of radiance 3, both with some noise.
            values_of(wall, "emission")[at] = x < 10 ? 5.0F + 0.1F * static_cast<float>(x) : 3.0F;
            values_of(wall, "")[at] += values_of(wall, "emission")[at];
            if (x >= 10) values_of(wall, "albedo")[at] = 0.0F;
        }
        if (x >= 10) values_of(wall, "depth")[i] = 0.0F;
    }
    const std::vector<float> result = statistical_filter(wall, samples, view);
    for (std::size_t at = 0; at < result.size(); ++at) {
        if (at % edge < 20)
            EXPECT_EQ(result[at], values_of(wall, "")[at]);
        else
            EXPECT_NEAR(result[at] / albedo, 1.0, 0.3);
    }
}

TEST(StatisticalFilter, ASingleBrightPathLeavesNoBlot) {
    constexpr std::uint32_t edge = 32;
    constexpr std::size_t bright = 16 * edge + 16;
    constexpr std::uint64_t few = 16;
    Image wall = dark_wall(edge, edge);
    shine(wall, even, 0.1, 10);
    for (std::size_t c = 0; c < 3; ++c) {
        // One of 16 samples has 16 000: mean and standard error are 1000.
        values_of(wall, "")[c * edge * edge + bright] = 1000.0F * albedo;
        values_of(wall, "variance")[c * edge * edge + bright] = 1e6F * albedo * albedo;
    }
    // Without care it would add 17 to its neighbours: a weight of about 1 in 57 of 1000.
    const std::vector<float> result = statistical_filter(wall, few, view);
    for (std::size_t i = 0; i < std::size_t{edge} * edge; ++i) {
        if (i != bright) {
            EXPECT_NEAR(result[i] / albedo, 1.0, 0.5) << i;
        }
    }
}

TEST(StatisticalFilter, ScalesWithTheLight) {
    Image wall = dark_wall(40, 24);
    shine(
        wall, [](std::size_t x, std::size_t y) { return 1.0 + 0.01 * static_cast<double>(x * y); },
        0.1, 11);
    const std::vector<float> plain = statistical_filter(wall, samples, view);
    for (const int exponent : {-60, -20, 50}) {
        Image scaled = wall;
        for (float& value : values_of(scaled, "")) value = std::ldexp(value, exponent);
        for (float& value : values_of(scaled, "variance")) value = std::ldexp(value, 2 * exponent);
        std::vector<float> expected = plain;
        for (float& value : expected) value = std::ldexp(value, exponent);
        EXPECT_EQ(statistical_filter(scaled, samples, view), expected) << exponent;
    }
}

TEST(StatisticalFilter, StaysFiniteAtAnySizeAndWithAnyValues) {
    constexpr float most = std::numeric_limits<float>::max();
    constexpr float least = std::numeric_limits<float>::denorm_min();
    for (const auto& [width, height] : {std::pair(1U, 1U), {1U, 9U}, {9U, 1U}, {129U, 3U}})
        for (const float value : {0.0F, least, 1e-30F, 1e30F, most})
            for (const float variance : {0.0F, least, 1.0F, most})
                for (const std::uint64_t count : {std::uint64_t{2}, std::uint64_t{1} << 40}) {
                    Image wall = dark_wall(width, height);
                    shine(wall, even, 0.1, 12);
                    values_of(wall, "")[0] = value;
                    values_of(wall, "variance")[0] = variance;
                    values_of(wall, "albedo")[0] = value > 1.0F ? 1.0F : value;
                    for (const float result : statistical_filter(wall, count, view)) {
                        EXPECT_TRUE(std::isfinite(result));
                        EXPECT_GE(result, 0.0F);
                    }
                }
}

TEST(StatisticalFilter, DoesNotDependOnTheNumberOfThreads) {
    Image wall = dark_wall(200, 100);
    shine(
        wall, [](std::size_t x, std::size_t) { return x < 70 ? 1.0 : 1.3; }, 0.1, 13);
    const std::vector<float> many = statistical_filter(wall, samples, view);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(statistical_filter(wall, samples, view), many);
}

TEST(StatisticalFilter, NamesALayerThatIsMissing) {
    for (const char* const name : {"", "emission", "albedo", "normal", "depth", "variance"}) {
        Image wall = dark_wall(4, 4);
        std::erase_if(wall.layers, [&](const Layer& layer) { return layer.name == name; });
        EXPECT_THROW((void)statistical_filter(wall, samples, view), std::invalid_argument) << name;
    }
}

}  // namespace
}  // namespace weft::statistical_filter_test
