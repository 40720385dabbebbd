// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "metrics/numeric.h"

namespace weft {
namespace {

using Values = std::vector<float>;

Values constant(std::size_t count, float value) {
    return Values(count, value);
}

Values noise(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    Values values(count);
    for (float& value : values) value = uniform(random);
    return values;
}

RelativeErrors errors_of(const Values& reference, const Values& test, std::uint32_t width,
                         std::uint32_t height) {
    return relative_errors({reference, width, height}, {test, width, height});
}

TEST(NumericMetrics, RelativeErrorsOfAConstantShift) {
    const RelativeErrors errors = errors_of(constant(300, 0.5F), constant(300, 0.75F), 10, 10);
    // 0.25^2 / (0.5^2 + 0.01 * 0.5^2) and 0.25 / (0.5 + 0.005)
    EXPECT_NEAR(errors.relmse.value(), 0.25 / 1.01, 1e-12);
    EXPECT_NEAR(errors.relmse_trimmed.value(), 0.25 / 1.01, 1e-12);
    EXPECT_NEAR(errors.mape.value(), 0.5 / 1.01, 1e-12);
    EXPECT_NEAR(errors.mean_ratio.value(), 1.5, 1e-12);
    EXPECT_NEAR(errors.bias.value(), 0.5, 1e-12);
    ASSERT_EQ(errors.relmse_map.size(), 100u);
    EXPECT_NEAR(errors.relmse_map[99], 0.25 / 1.01, 1e-6);
}

TEST(NumericMetrics, RelativeErrorsByHand) {
    // Two pixels, planar; the mean of the reference is 2.
    const Values reference = {1.0F, 3.0F, 0.0F, 4.0F, 2.0F, 2.0F};
    const Values test = {1.0F, 2.0F, 1.0F, 4.0F, 0.0F, 2.0F};
    const double eps = 0.04;
    const RelativeErrors errors = errors_of(reference, test, 2, 1);
    const double expected = (1.0 / (9.0 + eps) + 1.0 / eps + 4.0 / (4.0 + eps)) / 6.0;
    EXPECT_NEAR(errors.relmse.value(), expected, 1e-12);
    EXPECT_NEAR(errors.mape.value(), (1.0 / 3.02 + 1.0 / 0.02 + 2.0 / 2.02) / 6.0, 1e-12);
    EXPECT_NEAR(errors.mean_ratio.value(), 10.0 / 12.0, 1e-12);
    EXPECT_NEAR(errors.relmse_map[0], (1.0 / eps + 4.0 / (4.0 + eps)) / 3.0, 1e-5);
    EXPECT_NEAR(errors.relmse_map[1], 1.0 / (9.0 + eps) / 3.0, 1e-6);
}

TEST(NumericMetrics, RelativeErrorsDoNotDependOnScale) {
    const Values reference = noise(300, 1);
    const Values test = noise(300, 2);
    const auto scaled = [](Values values) {
        for (float& value : values) value *= 0x1p+40F;
        return values;
    };
    const RelativeErrors small = errors_of(reference, test, 10, 10);
    const RelativeErrors large = errors_of(scaled(reference), scaled(test), 10, 10);
    EXPECT_NEAR(large.relmse.value(), small.relmse.value(), 1e-9);
    EXPECT_NEAR(large.mape.value(), small.mape.value(), 1e-9);
    EXPECT_GT(small.relmse.value(), 0.1);
}

TEST(NumericMetrics, TrimmingDropsTheWorstThousandth) {
    const Values reference = constant(std::size_t{3} * 2000, 1.0F);
    Values test = reference;
    for (std::size_t c = 0; c < 3; ++c) {
        test[c * 2000 + 7] = 1000.0F;
        test[c * 2000 + 1999] = 1000.0F;
        test[c * 2000 + 500] = 2.0F;
    }
    const RelativeErrors errors = errors_of(reference, test, 50, 40);
    EXPECT_NEAR(errors.relmse_trimmed.value(), 1.0 / 1.01 / 1998.0, 1e-12);
    EXPECT_GT(errors.relmse.value(), 900.0);
    // One pixel in a hundred cannot be dropped.
    const RelativeErrors few = errors_of(constant(300, 1.0F), noise(300, 3), 10, 10);
    EXPECT_DOUBLE_EQ(few.relmse_trimmed.value(), few.relmse.value());
}

TEST(NumericMetrics, ABlackReferenceHasNoRelativeErrors) {
    const RelativeErrors errors = errors_of(constant(300, 0.0F), constant(300, 0.5F), 10, 10);
    EXPECT_FALSE(errors.relmse || errors.relmse_trimmed || errors.mape);
    EXPECT_FALSE(errors.mean_ratio || errors.bias);
    EXPECT_TRUE(std::isinf(errors.relmse_map[0]));
    const RelativeErrors same = errors_of(constant(300, 0.0F), constant(300, 0.0F), 10, 10);
    EXPECT_EQ(same.relmse.value(), 0.0);
    EXPECT_EQ(same.mape.value(), 0.0);
    EXPECT_FALSE(same.mean_ratio);
}

TEST(NumericMetrics, RelativeErrorsOfExtremesAreFinite) {
    const RelativeErrors errors = errors_of({1e-38F, 0.0F, 0.0F}, {3e38F, -3e38F, 0.0F}, 1, 1);
    EXPECT_TRUE(std::isfinite(errors.relmse.value()));
    const RelativeErrors negative = errors_of(constant(3, -1.0F), constant(3, 1.0F), 1, 1);
    EXPECT_NEAR(negative.relmse.value(), 4.0 / 1.01, 1e-12);
    EXPECT_NEAR(negative.mape.value(), 2.0 / 1.01, 1e-12);
}

TEST(NumericMetrics, PsnrOfAConstantShift) {
    EXPECT_NEAR(psnr(constant(10, 0.5F), constant(10, 0.75F), 1.0), 20.0 * std::log10(4.0), 1e-12);
    EXPECT_NEAR(psnr(constant(10, 10.0F), constant(10, 20.0F), 255.0), 20.0 * std::log10(25.5),
                1e-12);
    EXPECT_EQ(psnr(constant(10, 0.5F), constant(10, 0.5F), 1.0),
              std::numeric_limits<double>::infinity());
    EXPECT_THROW(static_cast<void>(psnr(constant(2, 0.0F), constant(3, 0.0F), 1.0)),
                 std::invalid_argument);
}

/// Every window on its own, in two dimensions and two passes.
double brute_force_ssim(const Values& a, const Values& b, int width, int height, double range) {
    const double c1 = std::pow(0.01 * range, 2);
    const double c2 = std::pow(0.03 * range, 2);
    double total = 0.0;
    for (int y = 0; y + 11 <= height; ++y)
        for (int x = 0; x + 11 <= width; ++x) {
            double weights = 0.0, mean_a = 0.0, mean_b = 0.0;
            const auto each = [&](auto use) {
                for (int j = 0; j < 11; ++j)
                    for (int i = 0; i < 11; ++i) {
                        const double square = (i - 5) * (i - 5) + (j - 5) * (j - 5);
                        const auto place = static_cast<std::size_t>((y + j) * width + x + i);
                        use(std::exp(-square / 4.5), double{a[place]}, double{b[place]});
                    }
            };
            each([&](double w, double p, double q) {
                weights += w;
                mean_a += w * p;
                mean_b += w * q;
            });
            mean_a /= weights;
            mean_b /= weights;
            double var_a = 0.0, var_b = 0.0, cov = 0.0;
            each([&](double w, double p, double q) {
                var_a += w * (p - mean_a) * (p - mean_a) / weights;
                var_b += w * (q - mean_b) * (q - mean_b) / weights;
                cov += w * (p - mean_a) * (q - mean_b) / weights;
            });
            total += (2 * mean_a * mean_b + c1) * (2 * cov + c2) /
                     ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
        }
    return total / ((width - 10) * (height - 10));
}

TEST(NumericMetrics, SsimAgreesWithItsDefinition) {
    for (const auto& [width, height] : {std::pair{11, 11}, std::pair{23, 14}, std::pair{12, 31}}) {
        const auto count = static_cast<std::size_t>(width * height);
        Values a = noise(count, 4);
        Values b = noise(count, 5);
        for (std::size_t i = 0; i < count; ++i) b[i] = 0.7F * a[i] + 0.3F * b[i];
        const auto w = static_cast<std::uint32_t>(width);
        const auto h = static_cast<std::uint32_t>(height);
        const double expected = brute_force_ssim(a, b, width, height, 1.0);
        EXPECT_NEAR(ssim(a, b, w, h, 1.0).value(), expected, 1e-12);
        EXPECT_GT(expected, 0.3);
        EXPECT_LT(expected, 0.95);
        // Far from zero, where squares cancel.
        for (std::size_t i = 0; i < count; ++i) {
            a[i] += 1e4F;
            b[i] += 1e4F;
        }
        EXPECT_NEAR(ssim(a, b, w, h, 1.0).value(), brute_force_ssim(a, b, width, height, 1.0),
                    1e-9);
    }
}

TEST(NumericMetrics, SsimOfConstantsIsTheirLuminanceTerm) {
    const Values a = constant(400, 0.25F);
    const Values b = constant(400, 0.75F);
    EXPECT_NEAR(ssim(a, b, 20, 20, 1.0).value(), (2 * 0.1875 + 1e-4) / (0.0625 + 0.5625 + 1e-4),
                1e-12);
    EXPECT_EQ(ssim(a, a, 20, 20, 1.0).value(), 1.0);
    const Values c = noise(400, 6);
    EXPECT_DOUBLE_EQ(ssim(c, c, 20, 20, 1.0).value(), 1.0);
    EXPECT_FALSE(ssim(a, a, 40, 10, 1.0)) << "no window fits";
}

TEST(NumericMetrics, Pu21) {
    // Values of the authors' function, banding and glare.
    const std::vector<std::pair<double, double>> known = {{0.1, 5.71707},    {1.0, 36.54391},
                                                          {10.0, 123.64748}, {100.0, 256.38390},
                                                          {1e3, 420.09692},  {1e4, 595.39392}};
    for (const auto& [luminance, units] : known)
        EXPECT_NEAR(pu21_encode(luminance), units, 1e-4) << luminance;
    EXPECT_EQ(pu21_encode(0.0), pu21_encode(0.005));
    EXPECT_EQ(pu21_encode(-1.0), pu21_encode(0.005));
    EXPECT_EQ(pu21_encode(1e30), pu21_encode(1e4));
    EXPECT_GE(pu21_encode(0.005), 0.0);
    const Values encoded = pu21_encode(constant(2, 0.5F), 200.0);
    EXPECT_NEAR(encoded[1], 256.38390, 1e-3);
}

TEST(NumericMetrics, SrgbEncoding) {
    // IEC 61966-2-1: 0.0031308 is the end of the linear part; half of the codes is at 0.2140.
    const Values encoded = srgb_encode(Values{-1.0F, 0.0F, 0.001F, 0.21404114F, 1.0F, 5.0F});
    const Values expected = {0.0F, 0.0F, 0.01292F, 0.5F, 1.0F, 1.0F};
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(encoded[i], expected[i], 1e-6);
}

TEST(NumericMetrics, LuminanceOfEqualChannelsIsTheirValue) {
    const Values values = {1.0F, 0.0F, 1.0F, 0.0F, 1.0F, 1.0F};
    const Values y = luminance({values, 2, 1});
    EXPECT_FLOAT_EQ(y[0], 1.0F);
    EXPECT_FLOAT_EQ(y[1], 0.072186F);
}

}  // namespace
}  // namespace weft
