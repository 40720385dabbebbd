// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "metrics/numeric.h"

namespace weft::numeric_metrics_test {
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

// Stimuli for other programs, tests/metrics/original_answers.py: all values are floats exactly.
constexpr int stimulus_width = 63;
constexpr int stimulus_height = 47;

using Formula = int(int x, int y);

int ramp(int x, int y) {
    return 2 * x + y;
}

int ramp_with_patch(int x, int y) {
    return ramp(x, y) + (x >= 24 && x < 40 && y >= 16 && y < 28 ? 16 : 0);
}

int checker(int x, int y) {
    return 16 * (1 + (x / 8 * 7 + y / 8 * 3) * 3 % 14);
}

int noisy_checker(int x, int y) {
    return checker(x, y) + (7 * x * x + 5 * x * y + 13 * y + 29) % 17 - 8;
}

int edge(int x, int y) {
    return 2 * x + y < 88 ? 16 : 192;
}

int shifted_edge(int x, int y) {
    return edge(x - 1, y);
}

/// From 2^-10 to 1920 times 2^17.
int high_range(int x, int y) {
    return (8 + (5 * x + 3 * y + 7) % 8) << (20 * x / 62 + 4);
}

int striped_range(int x, int y) {
    return high_range(x, y) / 16 * (16 + (3 * x + 5 * y + 1) % 4);
}

/// `width` columns and `height` rows from the column `left` and the row `top`, divided by `unit`.
Values part_of(Formula* formula, float unit, int left, int top, int width, int height) {
    Values values;
    for (int y = top; y < top + height; ++y)
        for (int x = left; x < left + width; ++x)
            values.push_back(static_cast<float>(formula(x, y)) / unit);
    return values;
}

// Answers of structural_similarity of scikit-image 0.26.0, set up as its documentation says to be
// that of the authors of SSIM: gaussian_weights=True, sigma=1.5, use_sample_covariance=False.
TEST(NumericMetrics, SsimAgreesWithScikitImage) {
    struct Case {
        Formula *reference, *test;
        float unit;
        double range, mean;
        std::array<double, 5> map;  // at `pixels`
    };
    constexpr std::array<std::array<int, 2>, 5> pixels = {
        {{24, 16}, {30, 20}, {33, 23}, {38, 25}, {45, 40}}};
    // Both compute in double precision, and the answers have 13 digits.
    constexpr double tolerance = 1e-12;
    const Case cases[] = {
        {ramp,
         ramp_with_patch,
         256.0F,
         1.0,
         0.9515777614625,
         {0.6513738768949, 0.9804830395425, 0.9833350885008, 0.5784171884826, 1.0000000000000}},
        {checker,
         noisy_checker,
         256.0F,
         1.0,
         0.9919990401190,
         {0.9962335564106, 0.9926453526817, 0.9976747957892, 0.9966504488619, 0.9981755835241}},
        {edge,
         shifted_edge,
         256.0F,
         1.0,
         0.8829699685276,
         {1.0000000000000, 0.3764102872715, 0.5799475079484, 0.8993872672428, 1.0000000000000}},
        {ramp,
         noisy_checker,
         256.0F,
         1.0,
         0.0289106290083,
         {0.0406495206353, -0.0445032122518, 0.0278873236409, 0.0057272023260, 0.0401564155710}},
        {high_range,
         striped_range,
         0x1p17F,
         256.0,
         0.9935143701189,
         {0.9999156673785, 0.9989394452968, 0.9978634521500, 0.9933927846614, 0.9829447434907}},
    };
    for (const auto& [reference, test, unit, range, mean, map] : cases) {
        const auto similarity = [&, a = reference, b = test, u = unit, r = range](
                                    int left, int top, int width, int height) {
            return ssim(part_of(a, u, left, top, width, height),
                        part_of(b, u, left, top, width, height), static_cast<std::uint32_t>(width),
                        static_cast<std::uint32_t>(height), r)
                .value();
        };
        EXPECT_NEAR(similarity(0, 0, stimulus_width, stimulus_height), mean, tolerance);
        // An image as large as the window is one pixel of the map.
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const auto [x, y] = pixels[i];
            EXPECT_NEAR(similarity(x - 5, y - 5, 11, 11), map[i], tolerance) << x << " " << y;
        }
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
    // Answers of cvvdp 0.5.7 from PyPI, by an author of PU21: class PU, banding and glare. They
    // have ten decimals.
    constexpr std::pair<double, double> known[] = {
        {0x1p-7, 0.2125674424},   {0x1p-5, 1.7919435233},    {0x1p-3, 7.0052517846},
        {0x1p-1, 22.2086836130},  {0x1p1, 56.5354894784},    {0x1p3, 112.8344330258},
        {0x1p5, 186.2830002217},  {0x1p7, 272.5936519332},   {0x1p9, 369.8261245624},
        {0x1p11, 475.5020962981}, {0x1p13, 581.2205899298},  {0.005, 0.0000000005},
        {100.0, 256.3838973127},  {10000.0, 595.3939200201},
    };
    for (const auto& [luminance, units] : known)
        EXPECT_NEAR(pu21_encode(luminance), units, 1e-9) << luminance;
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
    const Values y = luminance(RgbView{values, 2, 1});
    EXPECT_FLOAT_EQ(y[0], 1.0F);
    EXPECT_FLOAT_EQ(y[1], 0.072186F);
}

}  // namespace
}  // namespace weft::numeric_metrics_test
