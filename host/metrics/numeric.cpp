// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/numeric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "base/srgb.h"

namespace weft {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A relative error: 0 for 0 / 0, and +Inf for anything else divided by 0.
double ratio(double error, double size) {
    if (error == 0.0) return 0.0;
    return size > 0.0 ? error / size : infinity;
}

std::optional<double> finite(double value) {
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

double mean_of(std::span<const float> values) {
    double sum = 0.0;
    for (const float value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// The mean without the largest `dropped` values.
double trimmed_mean(std::vector<double> values, std::size_t dropped) {
    const std::size_t kept = values.size() - dropped;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(kept - 1),
                     values.end());
    double sum = 0.0;
    for (std::size_t i = 0; i < kept; ++i) sum += values[i];
    return sum / static_cast<double>(kept);
}

void check_planes(std::span<const float> a, std::span<const float> b) {
    if (a.empty() || a.size() != b.size())
        throw std::invalid_argument("metrics need two images of one size");
}

constexpr std::size_t window = 11;
using Taps = std::array<double, window>;

Taps gaussian_taps() {
    constexpr double sigma = 1.5;
    Taps taps{};
    double sum = 0.0;
    for (std::size_t i = 0; i < window; ++i) {
        const double x = static_cast<double>(i) - static_cast<double>(window / 2);
        taps[i] = std::exp(-x * x / (2.0 * sigma * sigma));
        sum += taps[i];
    }
    for (double& tap : taps) tap /= sum;
    return taps;
}

/// The sums that SSIM is made of, for one pixel or weighted over a window.
struct Moments {
    double a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;

    void add(double weight, const Moments& m) {
        a += weight * m.a;
        b += weight * m.b;
        aa += weight * m.aa;
        bb += weight * m.bb;
        ab += weight * m.ab;
    }
};

/// Similarity of two windows whose values lack `offset`.
double similarity(const Moments& m, double offset, double range) {
    const double c1 = std::pow(0.01 * range, 2.0);
    const double c2 = std::pow(0.03 * range, 2.0);
    const double variance_a = std::max(0.0, m.aa - m.a * m.a);
    const double variance_b = std::max(0.0, m.bb - m.b * m.b);
    const double covariance = m.ab - m.a * m.b;
    const double mean_a = m.a + offset;
    const double mean_b = m.b + offset;
    return (2.0 * mean_a * mean_b + c1) * (2.0 * covariance + c2) /
           ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
}

}  // namespace

RelativeErrors relative_errors(const RgbView& reference, const RgbView& test) {
    check_pair(reference, test);
    const double mean = mean_of(reference.values);
    const double eps = 1e-2 * mean * mean;
    const std::size_t pixels = reference.pixels();
    std::vector<double> errors(pixels, 0.0);
    double absolute = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < pixels; ++i) {
            const double r = reference.plane(c)[i];
            const double d = double{test.plane(c)[i]} - r;
            errors[i] += ratio(d * d, r * r + eps) / 3.0;
            absolute += ratio(std::abs(d), std::abs(r) + 1e-2 * std::abs(mean));
        }
    RelativeErrors result;
    result.relmse_map.assign(errors.begin(), errors.end());
    result.relmse = finite(trimmed_mean(errors, 0));
    result.relmse_trimmed = finite(trimmed_mean(std::move(errors), pixels / 1000));
    result.mape = finite(absolute / static_cast<double>(3 * pixels));
    if (mean != 0.0) result.mean_ratio = finite(mean_of(test.values) / mean);
    if (result.mean_ratio) result.bias = *result.mean_ratio - 1.0;
    return result;
}

double psnr(std::span<const float> reference, std::span<const float> test, double peak) {
    check_planes(reference, test);
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const double d = double{test[i]} - double{reference[i]};
        sum += d * d;
    }
    const double mse = sum / static_cast<double>(reference.size());
    return mse > 0.0 ? 10.0 * std::log10(peak * peak / mse) : infinity;
}

std::optional<double> ssim(std::span<const float> reference, std::span<const float> test,
                           std::uint32_t width, std::uint32_t height, double range) {
    check_planes(reference, test);
    if (reference.size() != std::size_t{width} * height)
        throw std::invalid_argument("metrics need two images of one size");
    if (width < window || height < window) return std::nullopt;
    const Taps taps = gaussian_taps();
    // Variances do not depend on an offset, but have far less rounding without it where values are
    // large.
    const double offset = mean_of(reference);
    const std::size_t columns = width - window + 1;
    std::vector<Moments> rows(columns * window);  // the last rows, each weighted along itself
    std::vector<Moments> pixels(width);
    double sum = 0.0;
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            const double a = double{reference[y * width + x]} - offset;
            const double b = double{test[y * width + x]} - offset;
            pixels[x] = {a, b, a * a, b * b, a * b};
        }
        for (std::size_t x = 0; x < columns; ++x) {
            Moments& row = rows[y % window * columns + x];
            row = {};
            for (std::size_t k = 0; k < window; ++k) row.add(taps[k], pixels[x + k]);
        }
        if (y + 1 < window) continue;
        for (std::size_t x = 0; x < columns; ++x) {
            Moments moments;
            for (std::size_t k = 0; k < window; ++k)
                moments.add(taps[k], rows[(y + 1 + k) % window * columns + x]);
            sum += similarity(moments, offset, range);
        }
    }
    return sum / static_cast<double>(columns * (height - window + 1));
}

double pu21_encode(double luminance) {
    constexpr std::array<double, 7> p = {0.353487901,   0.3734658629, 8.277049286e-5, 0.9062562627,
                                         0.09150303166, 0.9099517204, 596.3148142};
    const double y = std::pow(std::clamp(luminance, 0.005, 1e4), p[3]);
    return std::max(0.0, p[6] * (std::pow((p[0] + p[1] * y) / (1.0 + p[2] * y), p[4]) - p[5]));
}

std::vector<float> pu21_encode(std::span<const float> luminances, double scale) {
    std::vector<float> result(luminances.size());
    std::transform(luminances.begin(), luminances.end(), result.begin(), [&](float value) {
        return static_cast<float>(pu21_encode(scale * double{value}));
    });
    return result;
}

std::vector<float> srgb_encode(std::span<const float> linear) {
    std::vector<float> result(linear.size());
    std::transform(linear.begin(), linear.end(), result.begin(), [](float value) {
        return static_cast<float>(srgb_from_linear(std::clamp(double{value}, 0.0, 1.0)));
    });
    return result;
}

}  // namespace weft
