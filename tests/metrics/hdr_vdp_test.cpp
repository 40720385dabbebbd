// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/hdr_vdp.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/error.h"
#include "base/limits.h"
#include "tests/testing/hdr_vdp_stimuli.h"

namespace weft::hdr_vdp_test {
namespace {

constexpr std::uint32_t edge = 45;  // odd: no frequency is its own opposite
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

std::vector<float> noise(unsigned seed, float level = 1.0f) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> uniform(0.5f, 1.5f);
    std::vector<float> map(edge * edge);
    for (float& value : map) value = level * uniform(generator);
    return map;
}

HdrVdpResult compare_maps(const std::vector<float>& test, const std::vector<float>& reference,
                          const HdrVdpSettings& settings = {}) {
    return hdr_vdp(test, reference, edge, edge, settings);
}

ExitCode code_of(const std::vector<float>& test, const std::vector<float>& reference,
                 std::uint32_t width, std::uint32_t height, const HdrVdpSettings& settings = {}) {
    try {
        (void)hdr_vdp(test, reference, width, height, settings);
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::success;
}

TEST(HdrVdp, GaborPatchesAgreeWithTheOriginal) {
    constexpr GaborPatch patches[] = {{0.1, 2, .05, 0.333124, 0.001328, 0, 0},
                                      {1, 4, .05, 0.997109, 0.008050, 0.3616, 0.1022},
                                      {10, 8, .05, 0.999998, 0.011008, 0.6790, 0.3403},
                                      {100, 4, .01, 0.347521, 0.001079, 0, 0}};
    for (const GaborPatch& patch : patches) {
        const HdrVdpResult result = compare(patch, patch.background());
        EXPECT_NEAR(result.probability[stimulus_centre], patch.probability, 0.002) << patch.name();
        EXPECT_NEAR(result.mean, patch.mean, 0.005 * patch.mean) << patch.name();
        EXPECT_NEAR(result.p75, patch.p75, 0.0032) << patch.name();
        EXPECT_NEAR(result.p95, patch.p95, 0.0032) << patch.name();
    }
}

TEST(HdrVdp, CorrectFanFiltersLowerALowFrequency) {
    const GaborPatch patch{0.1, 2, .05, 0, 0, 0, 0};
    HdrVdpSettings settings = parity_settings();
    settings.legacy_fan = false;
    const HdrVdpResult result = compare(patch, patch.background(), settings);
    // With the legacy filters the same patch is at 0.333.
    EXPECT_NEAR(result.probability[stimulus_centre], 0.29, 0.01);
}

TEST(HdrVdp, CorrectOpticsGridPassesMore) {
    const GaborPatch patch{0.1, 2, .05, 0, 0, 0, 0};
    HdrVdpSettings settings = parity_settings();
    const double legacy = compare(patch, patch.background(), settings).mean;
    settings.legacy_otf_grid = false;
    const double correct = compare(patch, patch.background(), settings).mean;
    EXPECT_NE(correct, legacy);
    EXPECT_NEAR(correct, legacy, 0.03 * legacy);
}

TEST(HdrVdp, IsBlindToBrightnessOnBothSidesOfAStep) {
    const auto reference = [](std::uint32_t x, std::uint32_t) { return x < 128 ? 1.0 : 100.0; };
    const auto test = [&](std::uint32_t x, std::uint32_t y) { return 1.1 * reference(x, y); };
    EXPECT_LT(largest(compare(test, reference)), 5e-7f);
}

TEST(HdrVdp, IdenticalImagesDifferNowhere) {
    const std::vector<float> map = noise(1);
    const HdrVdpResult result = compare_maps(map, map);
    EXPECT_EQ(result.probability, std::vector<float>(map.size(), 0.0f));
    EXPECT_EQ(result.mean, 0.0);
    EXPECT_EQ(result.p75, 0.0);
    EXPECT_EQ(result.p95, 0.0);
}

TEST(HdrVdp, SummaryDescribesTheMap) {
    const HdrVdpResult result = compare_maps(noise(1, 0.01f), noise(2, 0.01f));
    double sum = 0.0;
    int above_75 = 0;
    int above_95 = 0;
    for (const float probability : result.probability) {
        EXPECT_GE(probability, 0.0f);
        EXPECT_LE(probability, 1.0f);
        sum += probability;
        above_75 += probability >= 0.75f;
        above_95 += probability >= 0.95f;
    }
    constexpr double pixels = edge * edge;
    EXPECT_NEAR(result.mean, sum / pixels, 1e-7);
    EXPECT_DOUBLE_EQ(result.p75, 100.0 * above_75 / pixels);
    EXPECT_DOUBLE_EQ(result.p95, 100.0 * above_95 / pixels);
    EXPECT_GT(above_95, 0);
    EXPECT_GT(above_75, above_95);
    EXPECT_LT(above_75, edge * edge);
}

// An image that is turned about a diagonal or shifted around its edges looks no different.
TEST(HdrVdp, FollowsASwapOfTheAxes) {
    const auto swapped = [](const std::vector<float>& map) {
        std::vector<float> result(map.size());
        for (std::uint32_t y = 0; y < edge; ++y)
            for (std::uint32_t x = 0; x < edge; ++x) result[x * edge + y] = map[y * edge + x];
        return result;
    };
    const HdrVdpSettings settings{.luminance_scale = 0.1};
    const HdrVdpResult straight = compare_maps(noise(1), noise(2), settings);
    const HdrVdpResult turned = compare_maps(swapped(noise(1)), swapped(noise(2)), settings);
    EXPECT_GT(straight.mean, 0.1);
    EXPECT_LT(straight.mean, 0.9);
    const std::vector<float> expected = swapped(straight.probability);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(turned.probability[i], expected[i], 1e-6) << i;
}

TEST(HdrVdp, FollowsACyclicShift) {
    const auto shifted = [](std::vector<float> map) {
        std::rotate(map.begin(), map.begin() + 17 * edge, map.end());
        return map;
    };
    const HdrVdpSettings settings{.luminance_scale = 1.0};
    const HdrVdpResult result = compare_maps(shifted(noise(1)), shifted(noise(2)), settings);
    const std::vector<float> expected =
        shifted(compare_maps(noise(1), noise(2), settings).probability);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(result.probability[i], expected[i], 1e-6) << i;
}

TEST(HdrVdp, LuminanceScaleIsAFactorOfBothMaps) {
    const std::vector<float> scaled =
        compare_maps(noise(1, 4.0f), noise(2, 4.0f), {.luminance_scale = 0.25}).probability;
    const std::vector<float> plain =
        compare_maps(noise(1), noise(2), {.luminance_scale = 1.0}).probability;
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(scaled[i], plain[i], 1e-6);
    EXPECT_GT(compare_maps(noise(1), noise(2), {.luminance_scale = 10.0}).mean,
              compare_maps(noise(1), noise(2), {.luminance_scale = 0.1}).mean + 0.1);
}

TEST(HdrVdp, LowerPeakContrastSeesMore) {
    const HdrVdpSettings keen{.luminance_scale = 0.1, .peak_contrast = 0.003};
    const HdrVdpSettings dull{.luminance_scale = 0.1, .peak_contrast = 0.03};
    EXPECT_GT(compare_maps(noise(1), noise(2), keen).mean,
              compare_maps(noise(1), noise(2), dull).mean + 0.1);
}

TEST(HdrVdp, ValuesThatAreNoLuminanceAreReplaced) {
    std::vector<float> test = noise(1);
    std::vector<float> reference = noise(2);
    test[100] = 0.25f;       // smallest of both
    reference[200] = 30.0f;  // largest of both
    std::vector<float> patched_test = test;
    std::vector<float> patched_reference = reference;
    const float bad[] = {0.0f, -0.0f, -3.0f, not_a_number, -infinity};
    for (std::size_t i = 0; i < std::size(bad); ++i) {
        test[300 + i] = reference[400 + i] = bad[i];
        patched_test[300 + i] = patched_reference[400 + i] = 0.25f;
    }
    test[500] = reference[600] = infinity;
    patched_test[500] = patched_reference[600] = 30.0f;
    const HdrVdpResult result = compare_maps(test, reference);
    EXPECT_EQ(result.probability, compare_maps(patched_test, patched_reference).probability);
    EXPECT_GT(result.mean, 0.0);
}

TEST(HdrVdp, PixelsBlackInBothAreEqual) {
    std::vector<float> test = noise(1);
    std::vector<float> reference = noise(2);
    test[7] = reference[7] = 0.0f;
    test[8] = 1e-3f;
    const HdrVdpResult result = compare_maps(test, reference);
    EXPECT_EQ(result.probability[7], 0.0f);
    EXPECT_GT(result.mean, 0.0);
}

TEST(HdrVdp, AMapWithoutLightIsDarkness) {
    const std::vector<float> black(edge * edge, 0.0f);
    const std::vector<float> nothing(edge * edge, not_a_number);
    EXPECT_EQ(compare_maps(black, black).mean, 0.0);
    EXPECT_EQ(compare_maps(black, nothing).mean, 0.0);
    const HdrVdpResult missing = compare_maps(black, noise(1));
    EXPECT_GT(missing.mean, 0.5);
    const std::vector<float> dark(edge * edge, 1e-6f);
    const std::vector<float> expected = compare_maps(dark, noise(1)).probability;
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(missing.probability[i], expected[i], 1e-6);
    const HdrVdpResult blinding = compare_maps(std::vector<float>(edge * edge, infinity), black);
    for (const float probability : blinding.probability) EXPECT_TRUE(std::isfinite(probability));
}

// Both test images are darker than anything the response tells apart.
TEST(HdrVdp, TheEyeAdaptsToTheReferenceAlone) {
    const std::vector<float> reference = noise(1, 2e-4f);
    const std::vector<float> dark(edge * edge, 1e-7f);
    const std::vector<float> darker(edge * edge, 1e-30f);
    const HdrVdpResult first = compare_maps(dark, reference);
    const HdrVdpResult second = compare_maps(darker, reference);
    EXPECT_GT(first.mean, 0.05);
    EXPECT_LT(first.mean, 0.95);
    for (std::size_t i = 0; i < first.probability.size(); ++i)
        EXPECT_NEAR(first.probability[i], second.probability[i], 1e-6) << i;
}

TEST(HdrVdp, ExtremeValuesStayFinite) {
    std::vector<float> test = noise(1);
    test[0] = std::numeric_limits<float>::denorm_min();
    test[1] = std::numeric_limits<float>::max();
    for (const double scale : {1e-12, 1.0, 1e12})
        for (const double ppd : {0.01, 1e5}) {
            const HdrVdpSettings settings{
                .pixels_per_degree = ppd, .luminance_scale = scale, .peak_contrast = 1e-6};
            for (const float probability : compare_maps(test, noise(2), settings).probability)
                ASSERT_TRUE(probability >= 0.0f && probability <= 1.0f) << scale << " " << ppd;
        }
}

TEST(HdrVdp, TakesTheSmallestAndUnevenImages) {
    constexpr std::uint32_t sizes[][2] = {{2, 2}, {2, 3}, {3, 2}, {2, 61}, {67, 2}, {5, 38}};
    for (const auto& [width, height] : sizes) {
        std::vector<float> reference(std::size_t{width} * height, 1.0f);
        std::vector<float> test = reference;
        test[0] = 50.0f;
        const HdrVdpResult result = hdr_vdp(test, reference, width, height, {});
        ASSERT_EQ(result.probability.size(), reference.size());
        for (std::size_t i = 1; i < reference.size(); ++i) EXPECT_EQ(result.probability[i], 0.0f);
        EXPECT_GT(result.probability[0], 0.9f) << width << " x " << height;
    }
}

TEST(HdrVdp, RefusesWrongSizes) {
    const std::vector<float> map(12, 1.0f);
    EXPECT_EQ(code_of(map, map, 4, 3), ExitCode::success);
    EXPECT_EQ(code_of(map, map, 12, 1), ExitCode::bad_input);
    EXPECT_EQ(code_of(map, map, 1, 12), ExitCode::bad_input);
    EXPECT_EQ(code_of(map, map, 4, 4), ExitCode::bad_input);
    EXPECT_EQ(code_of(map, std::vector<float>(11, 1.0f), 4, 3), ExitCode::bad_input);
    EXPECT_EQ(code_of(std::vector<float>(11, 1.0f), map, 4, 3), ExitCode::bad_input);
    EXPECT_EQ(code_of({}, {}, 0, 0), ExitCode::bad_input);
    EXPECT_EQ(code_of(map, map, 0xffffffffu, 0xffffffffu), ExitCode::bad_input);
    try {
        (void)hdr_vdp(map, map, 4, 4, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "HDR-VDP: the maps hold 12 and 12 values, expected 16");
    }
}

TEST(HdrVdp, RefusesSettingsOutOfRange) {
    const std::vector<float> map(12, 1.0f);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, 1e30, nan}) {
        EXPECT_EQ(code_of(map, map, 4, 3, {.pixels_per_degree = bad}), ExitCode::usage) << bad;
        EXPECT_EQ(code_of(map, map, 4, 3, {.viewing_distance = bad}), ExitCode::usage) << bad;
        EXPECT_EQ(code_of(map, map, 4, 3, {.luminance_scale = bad}), ExitCode::usage) << bad;
        EXPECT_EQ(code_of(map, map, 4, 3, {.peak_contrast = bad}), ExitCode::usage) << bad;
    }
}

}  // namespace
}  // namespace weft::hdr_vdp_test
