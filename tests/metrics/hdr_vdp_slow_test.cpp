// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "image/hdr.h"
#include "metrics/hdr_vdp.h"
#include "tests/testing/hdr_vdp_stimuli.h"

namespace weft::hdr_vdp_slow_test {
namespace {

namespace fs = std::filesystem;

// Of two pixels in percent, with what the original's answers are rounded to.
constexpr double percent_tolerance = 100.0 * 2 / (stimulus_edge * stimulus_edge) + 1e-4;

// Answers of the original program of 2005 (release 1.7.1) to the same stimuli.
constexpr GaborPatch patches[] = {
    {0.1, 2, .05, 0.333124, 0.001328, 0, 0},
    {0.1, 4, .05, 0.256343, 0.000778, 0, 0},
    {0.1, 8, .05, 0.005283, 0.000013, 0, 0},
    {1, 2, .02, 0.207300, 0.000785, 0, 0},
    {1, 2, .05, 0.996617, 0.010432, 0.4288, 0.1450},
    {1, 4, .05, 0.997109, 0.008050, 0.3616, 0.1022},
    {1, 8, .05, 0.466069, 0.001427, 0, 0},
    {10, 2, .02, 0.530231, 0.002294, 0, 0},
    {10, 4, .01, 0.129040, 0.000367, 0, 0},
    {10, 4, .02, 0.789584, 0.003326, 0.0137, 0},
    {10, 8, .02, 0.415091, 0.001236, 0, 0},
    {10, 8, .05, 0.999998, 0.011008, 0.6790, 0.3403},
    {100, 2, .02, 0.661751, 0.003117, 0, 0},
    {100, 4, .005, 0.037015, 0.000102, 0, 0},
    {100, 4, .01, 0.347521, 0.001079, 0, 0},
    {100, 4, .02, 0.991922, 0.007210, 0.3098, 0.0626},
    {100, 8, .01, 0.184461, 0.000496, 0, 0},
    {100, 8, .02, 0.899727, 0.004111, 0.0870, 0},
};

TEST(HdrVdpSlow, GaborPatchesAgreeWithTheOriginal) {
    for (const GaborPatch& patch : patches) {
        const HdrVdpResult result = compare(patch, patch.background());
        EXPECT_NEAR(result.probability[stimulus_centre], patch.probability, 0.002) << patch.name();
        EXPECT_NEAR(result.mean, patch.mean, 1e-6 + 0.005 * patch.mean) << patch.name();
        EXPECT_NEAR(result.p75, patch.p75, percent_tolerance) << patch.name();
        EXPECT_NEAR(result.p95, patch.p95, percent_tolerance) << patch.name();
    }
}

TEST(HdrVdpSlow, AWaveHidesTheSameWaveAsInTheOriginal) {
    constexpr double original[][3] = {
        {.05, 0.000661, 2e-6}, {.1, 0.008508, 2.3e-5}, {.2, 0.125001, 3.08e-4}};
    for (const auto& [contrast, probability, mean] : original) {
        const auto reference = [](std::uint32_t x, std::uint32_t) {
            return 50.0 * (1.0 + 0.3 * wave(x, 3.75));
        };
        const auto test = [&, c = contrast](std::uint32_t x, std::uint32_t y) {
            return reference(x, y) + 50.0 * c * wave(x, 3.75) * window(x, y);
        };
        const HdrVdpResult result = compare(test, reference);
        EXPECT_NEAR(largest(result), probability, 0.01 * probability + 5e-4) << contrast;
        EXPECT_NEAR(result.mean, mean, 0.01 * mean + 5e-7) << contrast;
    }
}

TEST(HdrVdpSlow, NoiseOnARampIsSeenAsInTheOriginal) {
    const auto reference = [](std::uint32_t x, std::uint32_t) {
        return std::pow(10.0, -2.0 + 5.0 * x / 255.0);
    };
    const auto test = [&](std::uint32_t x, std::uint32_t y) {
        return reference(x, y) * (1.0 + 0.03 * ((7 * x + 13 * y) % 17 / 8.0 - 1.0));
    };
    const HdrVdpResult result = compare(test, reference);
    EXPECT_NEAR(largest(result), 0.278832, 0.002);
    EXPECT_NEAR(result.mean, 0.015490, 5e-5);
}

std::vector<float> luminance_of(const Image& image) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    const std::vector<float>& rgb = image.layers.at(0).values;
    std::vector<float> luminance(pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        luminance[i] = static_cast<float>(0.212656 * rgb[i] + 0.715158 * rgb[pixels + i] +
                                          0.072186 * rgb[2 * pixels + i]);
    return luminance;
}

// The pair of images that comes with the original program.
TEST(HdrVdpSlow, PublicPairAgreesWithTheOriginal) {
    const char* shared = std::getenv("WEFT_SHARED");
    const fs::path folder =
        (shared != nullptr ? fs::path(shared) : fs::path(WEFT_SOURCE_DIR) / ".." / "shared") /
        "data/metrics/hdrvdp-pair/test";
    if (!fs::exists(folder / "memorial_mask.hdr"))
        GTEST_SKIP() << "no memorial_mask.hdr in " << folder << " (set WEFT_SHARED)";
    const Image test = read_hdr(folder / "memorial_sinnoise.hdr");
    const Image reference = read_hdr(folder / "memorial_mask.hdr");
    ASSERT_EQ(reference.width, 512u);
    ASSERT_EQ(reference.height, 768u);
    constexpr double original[][4] = {{1.0, 29.107, 24.129, 0.355684},
                                      {179.0, 29.779, 24.929, 0.361928}};
    for (const auto& [scale, p75, p95, mean] : original) {
        HdrVdpSettings settings = parity_settings();
        settings.luminance_scale = scale;
        const HdrVdpResult result =
            hdr_vdp(luminance_of(test), luminance_of(reference), 512, 768, settings);
        EXPECT_NEAR(result.p75, p75, 0.02) << scale;
        EXPECT_NEAR(result.p95, p95, 0.02) << scale;
        EXPECT_NEAR(result.mean, mean, 1e-4) << scale;
    }
}

}  // namespace
}  // namespace weft::hdr_vdp_slow_test
