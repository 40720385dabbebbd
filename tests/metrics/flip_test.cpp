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

namespace weft::flip_test {
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

// Stimuli for NVIDIA's program, tests/metrics/original_answers.py: all values are floats exactly.
constexpr int stimulus_width = 63;
constexpr int stimulus_height = 47;

using Formula = float(int x, int y, int c);

TestImage image_of(Formula* formula) {
    TestImage image{{}, stimulus_width, stimulus_height};
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < stimulus_height; ++y)
            for (int x = 0; x < stimulus_width; ++x) image.values.push_back(formula(x, y, c));
    return image;
}

float divided(int value, int divisor) {
    return static_cast<float>(value) / static_cast<float>(divisor);
}

float ramp(int x, int y, int c) {
    return divided(x * (c + 1) + y, 256);
}

float ramp_with_patch(int x, int y, int c) {
    const bool patch = x >= 24 && x < 40 && y >= 16 && y < 28;
    return ramp(x, y, c) + (patch ? divided(c + 1, 32) : 0.0F);
}

float checker(int x, int y, int c) {
    return divided(1 + (x / 8 * 7 + y / 8 * 3) * (2 * c + 1) % 14, 16);
}

float noisy_checker(int x, int y, int c) {
    return checker(x, y, c) + divided((7 * x * x + 5 * x * y + 13 * y + 29 * c) % 17 - 8, 256);
}

float edge(int x, int y, int c) {
    return 2 * x + y < 88 ? divided(c + 1, 32) : divided(7 - c, 8);
}

float shifted_edge(int x, int y, int c) {
    return edge(x - 1, y, c);
}

/// From 2^-10 to 1920.
float high_range(int x, int y, int c) {
    return std::ldexp(divided(8 + (5 * x + 3 * y + 7 * c) % 8, 8), 20 * x / 62 - 10);
}

float striped_range(int x, int y, int c) {
    return high_range(x, y, c) * divided(16 + (3 * x + 5 * y + c) % 4, 16);
}

float lamp_at(int centre, int x, int y, int c) {
    const bool disc = (x - centre) * (x - centre) + (y - 24) * (y - 24) < 36;
    return disc ? static_cast<float>(512 - 128 * c) : divided(1 + (x / 8 + y / 8 + c) % 3, 32);
}

float lamp(int x, int y, int c) {
    return lamp_at(32, x, y, c);
}

float shifted_lamp(int x, int y, int c) {
    return lamp_at(33, x, y, c);
}

/// What NVIDIA's program answers: the mean, and the map at `original_pixels`.
struct OriginalAnswer {
    double mean;
    std::array<float, 7> map;
};

constexpr std::array<std::array<int, 2>, 7> original_pixels = {
    {{0, 0}, {24, 16}, {30, 20}, {33, 23}, {38, 25}, {45, 40}, {62, 46}}};

// The original rounds every step to float. Where features are about equal, the square root of their
// difference makes more of that: 8e-5 at a few pixels, but less than 3e-6 at these. Means differ by
// less than 6e-7.
constexpr double map_tolerance = 1e-5;
constexpr double mean_tolerance = 2e-6;

void expect_original(const FlipResult& result, const OriginalAnswer& original) {
    EXPECT_NEAR(result.mean, original.mean, mean_tolerance);
    for (std::size_t i = 0; i < original_pixels.size(); ++i) {
        const auto [x, y] = original_pixels[i];
        EXPECT_NEAR(result.map[static_cast<std::size_t>(y * stimulus_width + x)], original.map[i],
                    map_tolerance)
            << x << " " << y;
    }
}

// Answers of NVIDIA's flip-evaluator 1.7 from PyPI with inputsRGB=False, that is for linear values.
TEST(Flip, AgreesWithTheOriginal) {
    struct Case {
        Formula *reference, *test;
        double ppd;
        OriginalAnswer answer;
    };
    const Case cases[] = {
        {ramp,
         ramp_with_patch,
         flip_default_ppd,
         {0.02285080,
          {0.0000000F, 0.1951952F, 0.2641599F, 0.2556322F, 0.2426854F, 0.0000000F, 0.0000000F}}},
        {checker,
         noisy_checker,
         flip_default_ppd,
         {0.05239433,
          {0.0847086F, 0.0285745F, 0.0320260F, 0.0373394F, 0.0841555F, 0.0290979F, 0.0702125F}}},
        {edge,
         shifted_edge,
         flip_default_ppd,
         {0.05403431,
          {0.0000000F, 0.0006286F, 0.1312559F, 0.5051612F, 0.0468202F, 0.0000000F, 0.0000000F}}},
        {checker,
         noisy_checker,
         20.0,
         {0.12982938,
          {0.2175526F, 0.1467518F, 0.1414357F, 0.1854147F, 0.1469953F, 0.0580704F, 0.1003858F}}},
    };
    for (const auto& [reference, test, ppd, answer] : cases) {
        expect_original(ldr_flip(image_of(reference).view(), image_of(test).view(), ppd), answer);
    }
}

struct HighRangeCase {
    Formula *reference, *test;
    FlipExposures exposures;
    OriginalAnswer answer;
};

// With given exposures and the original's default tone mapper, ACES.
TEST(Flip, OfHighRangesAgreesWithTheOriginal) {
    const HighRangeCase cases[] = {
        {high_range,
         striped_range,
         {-8, 4, 5},
         {0.11661595,
          {0.0493826F, 0.1177834F, 0.1392413F, 0.1283547F, 0.1441179F, 0.1287566F, 0.0361240F}}},
        {lamp,
         shifted_lamp,
         {-9, 3, 4},
         {0.03349627,
          {0.0000000F, 0.0259902F, 0.2283214F, 0.0373058F, 0.5912650F, 0.0000000F, 0.0000000F}}},
    };
    for (const auto& [reference, test, exposures, answer] : cases) {
        expect_original(hdr_flip(image_of(reference).view(), image_of(test).view(), exposures),
                        answer);
    }
}

// Here the original chooses the exposures. Images have an odd number of pixels, since of an even
// one its median is the larger of the two luminances in the middle, and ours their mean.
TEST(Flip, ExposuresAgreeWithTheOriginal) {
    const HighRangeCase cases[] = {
        {high_range,
         striped_range,
         {-9.738454, 0.9592999, 11},
         {0.11005563,
          {0.0054183F, 0.1376216F, 0.1398582F, 0.1394924F, 0.1422790F, 0.1396823F, 0.0748499F}}},
        {lamp,
         shifted_lamp,
         {-7.567651, 5.188305, 13},
         {0.03321811,
          {0.0000000F, 0.0227774F, 0.2365629F, 0.0297415F, 0.5899829F, 0.0000000F, 0.0000000F}}},
        {ramp,
         ramp_with_patch,
         {1.749738, 2.749738, 2},
         {0.01223940,
          {0.0000000F, 0.1393895F, 0.1575810F, 0.1379558F, 0.1281299F, 0.0000000F, 0.0000000F}}},
        {edge,
         shifted_edge,
         {1.464965, 5.188305, 4},
         {0.04906575,
          {0.0000000F, 0.0005272F, 0.1027854F, 0.4915750F, 0.0423839F, 0.0000000F, 0.0000000F}}},
    };
    for (const auto& [reference, test, original, answer] : cases) {
        // The original has four digits of the luminance weights of Rec.709, we have six. This
        // changes a saturated red by 3.8e-4 stops, and these images by less than 6e-5.
        constexpr double stops = 1e-4;
        const TestImage image = image_of(reference);
        const FlipExposures exposures = flip_exposures(image.view());
        EXPECT_NEAR(exposures.start, original.start, stops);
        EXPECT_NEAR(exposures.stop, original.stop, stops);
        EXPECT_EQ(exposures.count, original.count);
        expect_original(hdr_flip(image.view(), image_of(test).view(), exposures), answer);
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
}  // namespace weft::flip_test
