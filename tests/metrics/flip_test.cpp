// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace weft {
namespace {

struct TestImage {
    std::vector<float> values;
    std::uint32_t width, height;

    [[nodiscard]] RgbView view() const { return {values, width, height}; }
};

TestImage constant(std::uint32_t width, std::uint32_t height, std::array<float, 3> colour) {
    TestImage image{{}, width, height};
    for (const float value : colour)
        image.values.insert(image.values.end(), std::size_t{width} * height, value);
    return image;
}

TestImage noise(std::uint32_t width, std::uint32_t height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    TestImage image = constant(width, height, {});
    for (float& value : image.values) value = uniform(random);
    return image;
}

using Vector = std::array<double, 3>;

/// FLIP once more, straight from its definition: two-dimensional kernels, no rows and columns.
class BruteForce {
  public:
    BruteForce(const TestImage& image, double ppd) : image_(image), ppd_(ppd) {}

    [[nodiscard]] Vector filtered_rgb(int x, int y) const {
        const int radius = static_cast<int>(
            std::ceil(3.0 * std::sqrt(0.04 / (2.0 * std::numbers::pi * std::numbers::pi)) * ppd_));
        Vector sums{}, weights{};
        for (int j = -radius; j <= radius; ++j)
            for (int i = -radius; i <= radius; ++i) {
                const double squared = (i * i + j * j) / (ppd_ * ppd_);
                const Vector kernel = {csf(1.0, 0.0047, squared), csf(1.0, 0.0053, squared),
                                       csf(34.1, 0.04, squared) + csf(13.5, 0.025, squared)};
                const Vector colour = ycxcz(x + i, y + j);
                for (std::size_t c = 0; c < 3; ++c) {
                    sums[c] += kernel[c] * colour[c];
                    weights[c] += kernel[c];
                }
            }
        return rgb(sums[0] / weights[0], sums[1] / weights[1], sums[2] / weights[2]);
    }

    /// Lengths of the first and of the second derivatives.
    [[nodiscard]] std::array<double, 2> features(int x, int y) const {
        const double s = 0.5 * 0.082 * ppd_;
        const int radius = static_cast<int>(std::ceil(3.0 * s));
        std::array<double, 4> sums{};
        const std::array<std::function<double(double, double)>, 4> kernels = {
            [](double i, double) { return -i; }, [](double, double j) { return -j; },
            [s](double i, double) { return i * i / (s * s) - 1.0; },
            [s](double, double j) { return j * j / (s * s) - 1.0; }};
        for (std::size_t k = 0; k < 4; ++k) {
            double positive = 0.0, negative = 0.0, up = 0.0, down = 0.0;
            for (int j = -radius; j <= radius; ++j)
                for (int i = -radius; i <= radius; ++i) {
                    const double w = kernels[k](i, j) * std::exp(-(i * i + j * j) / (2.0 * s * s));
                    const double value = (ycxcz(x + i, y + j)[0] + 16.0) / 116.0;
                    (w > 0.0 ? positive : negative) += std::abs(w);
                    (w > 0.0 ? up : down) += std::abs(w) * value;
                }
            sums[k] = up / positive - down / negative;
        }
        return {std::hypot(sums[0], sums[1]), std::hypot(sums[2], sums[3])};
    }

    static double curve(double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : 841.0 / 108.0 * t + 4.0 / 29.0;
    }

    static Vector lab(const Vector& c) {
        const Vector n = xyz(c);
        const double l = 116.0 * curve(n[1]) - 16.0;
        return {l, 0.01 * l * 500.0 * (curve(n[0]) - curve(n[1])),
                0.01 * l * 200.0 * (curve(n[1]) - curve(n[2]))};
    }

  private:
    static double csf(double a, double b, double squared) {
        return a * std::sqrt(std::numbers::pi / b) *
               std::exp(-std::numbers::pi * std::numbers::pi * squared / b);
    }
    /// Over the white point, with the usual decimal matrix.
    static Vector xyz(const Vector& c) {
        return {(0.4123907993 * c[0] + 0.3575843394 * c[1] + 0.1804807884 * c[2]) / 0.950428545,
                0.2126390059 * c[0] + 0.7151686788 * c[1] + 0.0721923154 * c[2],
                (0.0193308187 * c[0] + 0.1191947798 * c[1] + 0.9505321522 * c[2]) / 1.0889};
    }
    [[nodiscard]] Vector ycxcz(int x, int y) const {
        const auto column = static_cast<std::size_t>(std::clamp(x, 0, int(image_.width) - 1));
        const auto row = static_cast<std::size_t>(std::clamp(y, 0, int(image_.height) - 1));
        const std::size_t i = row * image_.width + column;
        const RgbView view = image_.view();
        const Vector n = xyz({view.plane(0)[i], view.plane(1)[i], view.plane(2)[i]});
        return {116.0 * n[1] - 16.0, 500.0 * (n[0] - n[1]), 200.0 * (n[1] - n[2])};
    }
    static Vector rgb(double luma, double cx, double cz) {
        const double y = (luma + 16.0) / 116.0;
        const double x = 0.950428545 * (y + cx / 500.0);
        const double z = 1.0889 * (y - cz / 200.0);
        const Vector linear = {3.241003275 * x - 1.537398934 * y - 0.498615861 * z,
                               -0.969224334 * x + 1.875930071 * y + 0.041554224 * z,
                               0.055639423 * x - 0.204011202 * y + 1.057148933 * z};
        return {std::clamp(linear[0], 0.0, 1.0), std::clamp(linear[1], 0.0, 1.0),
                std::clamp(linear[2], 0.0, 1.0)};
    }

    const TestImage& image_;
    double ppd_;
};

double hyab(const Vector& a, const Vector& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

double colour_difference(const Vector& a, const Vector& b) {
    const double largest =
        std::pow(hyab(BruteForce::lab({0, 1, 0}), BruteForce::lab({0, 0, 1})), 0.7);
    const double powered = std::pow(hyab(BruteForce::lab(a), BruteForce::lab(b)), 0.7);
    const double cut = 0.4 * largest;
    return powered < cut ? 0.95 * powered / cut : 0.95 + 0.05 * (powered - cut) / (largest - cut);
}

double brute_force_flip(const BruteForce& a, const BruteForce& b, int x, int y) {
    const auto [edge_a, point_a] = a.features(x, y);
    const auto [edge_b, point_b] = b.features(x, y);
    const double feature = std::sqrt(
        std::max(std::abs(edge_a - edge_b), std::abs(point_a - point_b)) / std::sqrt(2.0));
    return std::pow(colour_difference(a.filtered_rgb(x, y), b.filtered_rgb(x, y)), 1.0 - feature);
}

// Wider than the blocks of the fast convolution, and less high than a kernel.
TEST(Flip, AgreesWithTheDefinition) {
    for (const double ppd : {67.0206432766, 20.0}) {
        const TestImage a = noise(37, 9, 1);
        const TestImage b = noise(37, 9, 2);
        const FlipResult result = ldr_flip(a.view(), b.view(), ppd);
        const BruteForce slow_a(a, ppd);
        const BruteForce slow_b(b, ppd);
        double sum = 0.0;
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 37; ++x) {
                const double expected = brute_force_flip(slow_a, slow_b, x, y);
                // Floats between the stages, and decimal matrices of ten digits.
                EXPECT_NEAR(result.map[static_cast<std::size_t>(y * 37 + x)], expected, 2e-4);
                sum += expected;
            }
        EXPECT_NEAR(result.mean, sum / (37 * 9), 5e-5);
        EXPECT_GT(result.mean, 0.05);
    }
}

TEST(Flip, OfConstantsIsTheirColourDifference) {
    const std::array<float, 3> grey = {0.2F, 0.2F, 0.2F};
    const std::array<float, 3> red = {0.6F, 0.1F, 0.05F};
    const TestImage a = constant(20, 20, grey);
    const TestImage b = constant(20, 20, red);
    const FlipResult result = ldr_flip(a.view(), b.view());
    const double expected = colour_difference({0.2, 0.2, 0.2}, {0.6, 0.1, 0.05});
    EXPECT_NEAR(result.mean, expected, 1e-4);
    for (const float value : result.map) EXPECT_NEAR(value, expected, 1e-4);
    const TestImage green = constant(4, 4, {0.0F, 1.0F, 0.0F});
    const TestImage blue = constant(4, 4, {0.0F, 0.0F, 1.0F});
    EXPECT_NEAR(ldr_flip(green.view(), blue.view()).mean, 1.0, 1e-4) << "the largest there is";
}

TEST(Flip, OfEqualImagesIsZeroAndOrderDoesNotMatter) {
    const TestImage a = noise(33, 21, 3);
    const TestImage b = noise(33, 21, 4);
    const FlipResult same = ldr_flip(a.view(), a.view());
    EXPECT_EQ(same.mean, 0.0);
    for (const float value : same.map) EXPECT_EQ(value, 0.0F);
    EXPECT_EQ(ldr_flip(a.view(), b.view()).map, ldr_flip(b.view(), a.view()).map);
    const TestImage pixel = constant(1, 1, {0.5F, 0.5F, 0.5F});
    EXPECT_EQ(ldr_flip(pixel.view(), pixel.view()).mean, 0.0);
}

TEST(Flip, ClampsToTheDisplay) {
    const TestImage white = constant(12, 12, {1.0F, 1.0F, 1.0F});
    const TestImage bright = constant(12, 12, {7.0F, 1.0F, 3e38F});
    EXPECT_EQ(ldr_flip(white.view(), bright.view()).mean, 0.0);
}

TEST(Flip, ExposuresPutBrightestAndMedianBelowWhite) {
    TestImage image = constant(5, 1, {0.25F, 0.25F, 0.25F});
    for (std::size_t c = 0; c < 3; ++c) image.values[c * 5] = 8.0F;
    const FlipExposures exposures = flip_exposures(image.view());
    const double x = 8.0 * std::exp2(exposures.start);
    EXPECT_NEAR((0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14), 0.85, 1e-6);
    EXPECT_NEAR(exposures.stop - exposures.start, 5.0, 1e-6);
    EXPECT_NEAR(exposures.count, 5.5, 0.5) << "rounding may make it six";
    image = constant(4, 4, {1.0F, 1.0F, 1.0F});
    EXPECT_EQ(flip_exposures(image.view()).count, 2);
}

TEST(Flip, ExposuresOfBlack) {
    const TestImage black = constant(4, 4, {});
    EXPECT_EQ(flip_exposures(black.view()).count, 1);
    EXPECT_EQ(flip_exposures(black.view()).start, 0.0);
    TestImage nearly = constant(9, 1, {});
    for (std::size_t c = 0; c < 3; ++c) nearly.values[c * 9 + 4] = 2.0F;
    const FlipExposures exposures = flip_exposures(nearly.view());
    EXPECT_TRUE(std::isfinite(exposures.start) && std::isfinite(exposures.stop));
    EXPECT_EQ(exposures.start, exposures.stop);
    const TestImage grey = constant(4, 4, {0.5F, 0.5F, 0.5F});
    const double mean = hdr_flip(black.view(), grey.view(), flip_exposures(black.view())).mean;
    EXPECT_GT(mean, 0.1);
    EXPECT_LE(mean, 1.0);
    EXPECT_EQ(hdr_flip(black.view(), black.view(), flip_exposures(black.view())).mean, 0.0);
}

// Exposures follow the reference, so that units do not matter.
TEST(Flip, OfHighRangesDoesNotDependOnTheirScale) {
    TestImage a = noise(24, 24, 5);
    TestImage b = noise(24, 24, 6);
    for (std::size_t i = 0; i < a.values.size(); i += 7) a.values[i] *= 100.0F;
    const double mean = hdr_flip(a.view(), b.view(), flip_exposures(a.view())).mean;
    for (TestImage* image : {&a, &b})
        for (float& value : image->values) value *= 0x1p-20F;
    EXPECT_NEAR(hdr_flip(a.view(), b.view(), flip_exposures(a.view())).mean, mean, 1e-6);
    EXPECT_GT(mean, 0.05);
}

TEST(Flip, OfHighRangesIsTheLargestOverTheExposures) {
    const TestImage a = noise(16, 16, 7);
    const TestImage b = noise(16, 16, 8);
    const FlipResult both = hdr_flip(a.view(), b.view(), {-3.0, 1.0, 2});
    const FlipResult dark = hdr_flip(a.view(), b.view(), {-3.0, -3.0, 1});
    const FlipResult bright = hdr_flip(a.view(), b.view(), {1.0, 1.0, 1});
    EXPECT_NE(dark.map, bright.map);
    for (std::size_t i = 0; i < both.map.size(); ++i)
        EXPECT_EQ(both.map[i], std::max(dark.map[i], bright.map[i]));
}

TEST(Flip, StaysInRangeForExtremeValues) {
    TestImage a = constant(12, 12, {3e38F, 1e-38F, 0.0F});
    const TestImage b = constant(12, 12, {-3e38F, 3e38F, 1.0F});
    const FlipResult result = hdr_flip(a.view(), b.view(), flip_exposures(a.view()));
    for (const float value : result.map) {
        EXPECT_GE(value, 0.0F);
        EXPECT_LE(value, 1.0F);
    }
}

TEST(Flip, RefusesWhatDoesNotFit) {
    const TestImage a = constant(4, 4, {});
    const TestImage b = constant(2, 8, {});
    EXPECT_THROW(static_cast<void>(ldr_flip(a.view(), b.view())), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(ldr_flip({}, {})), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(ldr_flip(a.view(), a.view(), 0.0)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(ldr_flip(a.view(), a.view(), 1e9)), std::invalid_argument);
}

}  // namespace
}  // namespace weft
