// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "metrics/convolve.h"

namespace weft {
namespace {

using glm::dmat3;
using glm::dvec3;
using Planes = std::array<std::vector<float>, 3>;

constexpr double colour_exponent = 0.7;  // q_c
constexpr double colour_cut = 0.4;       // p_c
constexpr double colour_cut_value = 0.95;
constexpr double feature_width = 0.082;  // degrees
constexpr double feature_exponent = 0.5;
const dvec3 illuminant(0.950428545, 1.0, 1.0889);

/// Linear Rec.709 to XYZ; glm takes columns.
dmat3 xyz_from_rgb() {
    return {dvec3(10135552.0 / 24577794.0, 2613072.0 / 12288897.0, 1425312.0 / 73733382.0),
            dvec3(8788810.0 / 24577794.0, 8788810.0 / 12288897.0, 8788810.0 / 73733382.0),
            dvec3(4435075.0 / 24577794.0, 887015.0 / 12288897.0, 70074185.0 / 73733382.0)};
}

dvec3 ycxcz_from_rgb(const dmat3& matrix, const dvec3& rgb) {
    const dvec3 n = matrix * rgb / illuminant;
    return {116.0 * n.y - 16.0, 500.0 * (n.x - n.y), 200.0 * (n.y - n.z)};
}

dvec3 rgb_from_ycxcz(const dmat3& inverse, const dvec3& c) {
    const double y = (c.x + 16.0) / 116.0;
    return inverse * (illuminant * dvec3(y + c.y / 500.0, y, y - c.z / 200.0));
}

/// L*a*b* with the Hunt effect: colour fades with lightness.
dvec3 hunt_lab(const dmat3& matrix, const dvec3& rgb) {
    constexpr double delta = 6.0 / 29.0;
    const dvec3 n = matrix * rgb / illuminant;
    const auto curve = [](double t) {
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
    };
    const double fy = curve(n.y);
    const double lightness = 116.0 * fy - 16.0;
    const double hunt = 0.01 * lightness;
    return {lightness, hunt * 500.0 * (curve(n.x) - fy), hunt * 200.0 * (fy - curve(n.z))};
}

double hyab(const dvec3& a, const dvec3& b) {
    const dvec3 d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

void normalise(std::vector<float>& taps, double sum) {
    for (float& tap : taps) tap = static_cast<float>(tap / sum);
}

double sum_of(const std::vector<float>& taps) {
    double sum = 0.0;
    for (const float tap : taps) sum += tap;
    return sum;
}

/// One contrast sensitivity Gaussian, sampled at the pixels; its scale is that of one dimension.
std::vector<float> csf_taps(double a, double b, int radius, double ppd) {
    constexpr double pi = std::numbers::pi;
    std::vector<float> taps;
    for (int x = -radius; x <= radius; ++x) {
        const double degrees = x / ppd;
        taps.push_back(static_cast<float>(std::sqrt(a * std::sqrt(pi / b)) *
                                          std::exp(-pi * pi * degrees * degrees / b)));
    }
    return taps;
}

/// An image in YCxCz filtered by the eye's contrast sensitivity, as linear RGB in [0, 1].
Planes filtered_colour(const Planes& ycxcz, std::uint32_t width, std::uint32_t height, double ppd) {
    constexpr double widest = 0.04;
    const int radius = static_cast<int>(
        std::ceil(3.0 * std::sqrt(widest / (2.0 * std::numbers::pi * std::numbers::pi)) * ppd));
    std::vector<float> y_taps = csf_taps(1.0, 0.0047, radius, ppd);
    std::vector<float> cx_taps = csf_taps(1.0, 0.0053, radius, ppd);
    std::vector<float> cz_narrow = csf_taps(34.1, 0.04, radius, ppd);
    std::vector<float> cz_wide = csf_taps(13.5, 0.025, radius, ppd);
    normalise(y_taps, sum_of(y_taps));
    normalise(cx_taps, sum_of(cx_taps));
    const double cz_sum = std::hypot(sum_of(cz_narrow), sum_of(cz_wide));
    normalise(cz_narrow, cz_sum);
    normalise(cz_wide, cz_sum);

    Planes result = {convolve(ycxcz[0], width, height, y_taps, y_taps),
                     convolve(ycxcz[1], width, height, cx_taps, cx_taps),
                     convolve(ycxcz[2], width, height, cz_narrow, cz_narrow)};
    const std::vector<float> second = convolve(ycxcz[2], width, height, cz_wide, cz_wide);
    const dmat3 inverse = glm::inverse(xyz_from_rgb());
    tbb::parallel_for(std::size_t{0}, second.size(), [&](std::size_t i) {
        const dvec3 colour(result[0][i], result[1][i], double{result[2][i]} + double{second[i]});
        const dvec3 rgb = glm::clamp(rgb_from_ycxcz(inverse, colour), 0.0, 1.0);
        for (int c = 0; c < 3; ++c)
            result[static_cast<std::size_t>(c)][i] = static_cast<float>(rgb[c]);
    });
    return result;
}

/// Derivatives of the achromatic image by x and y at the scale of features.
struct Features {
    std::vector<float> edge_x, edge_y, point_x, point_y;
};

Features features_of(const std::vector<float>& achromatic, std::uint32_t width,
                     std::uint32_t height, double ppd) {
    const double sigma = 0.5 * feature_width * ppd;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    std::vector<float> gauss, first, second;
    for (int x = -radius; x <= radius; ++x) {
        const double value = std::exp(-x * x / (2.0 * sigma * sigma));
        gauss.push_back(static_cast<float>(value));
        first.push_back(static_cast<float>(-x * value));
        second.push_back(static_cast<float>((x * x / (sigma * sigma) - 1.0) * value));
    }
    normalise(gauss, sum_of(gauss));
    for (std::vector<float>* taps : {&first, &second}) {
        double positive = 0.0;
        double negative = 0.0;
        for (const float tap : *taps) (tap > 0.0F ? positive : negative) += std::abs(double{tap});
        for (float& tap : *taps) tap = static_cast<float>(tap / (tap > 0.0F ? positive : negative));
    }
    const auto filtered = [&](const std::vector<float>& across, const std::vector<float>& down) {
        return convolve(achromatic, width, height, across, down);
    };
    return {filtered(first, gauss), filtered(gauss, first), filtered(second, gauss),
            filtered(gauss, second)};
}

/// All that the comparison needs of one image.
struct Perceived {
    Planes colour;
    Features features;
};

Perceived perceive(const RgbView& image, double ppd) {
    const dmat3 matrix = xyz_from_rgb();
    Planes ycxcz;
    for (auto& plane : ycxcz) plane.resize(image.pixels());
    std::vector<float> achromatic(image.pixels());
    tbb::parallel_for(std::size_t{0}, image.pixels(), [&](std::size_t i) {
        const dvec3 rgb(image.plane(0)[i], image.plane(1)[i], image.plane(2)[i]);
        const dvec3 c = ycxcz_from_rgb(matrix, glm::clamp(rgb, 0.0, 1.0));
        for (int k = 0; k < 3; ++k)
            ycxcz[static_cast<std::size_t>(k)][i] = static_cast<float>(c[k]);
        achromatic[i] = static_cast<float>((c.x + 16.0) / 116.0);
    });
    return {filtered_colour(ycxcz, image.width, image.height, ppd),
            features_of(achromatic, image.width, image.height, ppd)};
}

double colour_difference(double distance, double largest) {
    const double powered = std::pow(distance, colour_exponent);
    const double cut = colour_cut * largest;
    if (powered < cut) return powered * colour_cut_value / cut;
    return colour_cut_value + (powered - cut) / (largest - cut) * (1.0 - colour_cut_value);
}

double feature_difference(const Features& a, const Features& b, std::size_t i) {
    const auto length = [i](const std::vector<float>& x, const std::vector<float>& y) {
        return std::hypot(double{x[i]}, double{y[i]});
    };
    const double edge = std::abs(length(a.edge_x, a.edge_y) - length(b.edge_x, b.edge_y));
    const double point = std::abs(length(a.point_x, a.point_y) - length(b.point_x, b.point_y));
    return std::pow(std::max(edge, point) / std::numbers::sqrt2, feature_exponent);
}

std::vector<float> flip_map(const RgbView& reference, const RgbView& test, double ppd) {
    const Perceived a = perceive(reference, ppd);
    const Perceived b = perceive(test, ppd);
    const dmat3 matrix = xyz_from_rgb();
    const double largest =
        std::pow(hyab(hunt_lab(matrix, {0.0, 1.0, 0.0}), hunt_lab(matrix, {0.0, 0.0, 1.0})),
                 colour_exponent);
    std::vector<float> map(reference.pixels());
    tbb::parallel_for(std::size_t{0}, map.size(), [&](std::size_t i) {
        const auto lab = [&](const Planes& rgb) {
            return hunt_lab(matrix, {rgb[0][i], rgb[1][i], rgb[2][i]});
        };
        const double colour =
            std::clamp(colour_difference(hyab(lab(a.colour), lab(b.colour)), largest), 0.0, 1.0);
        const double feature = std::min(feature_difference(a.features, b.features, i), 1.0);
        map[i] = static_cast<float>(std::pow(colour, 1.0 - feature));
    });
    return map;
}

FlipResult with_mean(std::vector<float> map) {
    double sum = 0.0;
    for (const float value : map) sum += value;
    const double mean = sum / static_cast<double>(map.size());
    return {std::move(map), mean};
}

void check_ppd(double ppd) {
    if (!(ppd >= 1.0) || ppd > 1000.0)
        throw std::invalid_argument("FLIP needs 1 to 1000 pixels per degree");
}

/// The ACES fit of Narkowicz with its exposure of 0.6: (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5).
constexpr std::array<double, 6> aces = {0.9036, 0.018, 0.0, 0.8748, 0.354, 0.14};

double tone_curve(double x) {
    return std::clamp(
        (x * (aces[0] * x + aces[1]) + aces[2]) / (x * (aces[3] * x + aces[4]) + aces[5]), 0.0,
        1.0);
}

/// The scene value that the tone curve maps to 0.85.
double brightest_value() {
    constexpr double target = 0.85;
    const double a = aces[0] - target * aces[3];
    const double b = aces[1] - target * aces[4];
    const double c = aces[2] - target * aces[5];
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

std::vector<float> tone_mapped(const RgbView& image, double exposure) {
    const double scale = std::exp2(exposure);
    std::vector<float> result(image.values.size());
    tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t i) {
        result[i] = static_cast<float>(tone_curve(scale * std::max(0.0F, image.values[i])));
    });
    return result;
}

}  // namespace

FlipResult ldr_flip(const RgbView& reference, const RgbView& test, double pixels_per_degree) {
    check_pair(reference, test);
    check_ppd(pixels_per_degree);
    return with_mean(flip_map(reference, test, pixels_per_degree));
}

FlipExposures flip_exposures(const RgbView& reference) {
    std::vector<float> y = luminance(reference);
    const auto count_black = [](float value) { return !(value > 0.0F); };
    const auto black = std::count_if(y.begin(), y.end(), count_black);
    if (2 * static_cast<std::size_t>(black) >= y.size()) std::erase_if(y, count_black);
    if (y.empty()) return {};
    std::sort(y.begin(), y.end());
    const std::size_t upper = y.size() / 2;
    const std::size_t lower = (y.size() - 1) / 2;
    const double median = 0.5 * (double{y[lower]} + double{y[upper]});
    FlipExposures exposures;
    exposures.start = std::log2(brightest_value() / double{y.back()});
    exposures.stop = std::log2(brightest_value() / median);
    exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
    return exposures;
}

FlipResult hdr_flip(const RgbView& reference, const RgbView& test, const FlipExposures& exposures,
                    double pixels_per_degree) {
    check_pair(reference, test);
    check_ppd(pixels_per_degree);
    std::vector<float> largest(reference.pixels(), 0.0F);
    for (int i = 0; i < exposures.count; ++i) {
        const double part = exposures.count > 1 ? double(i) / (exposures.count - 1) : 0.0;
        const double exposure = exposures.start + part * (exposures.stop - exposures.start);
        const std::vector<float> a = tone_mapped(reference, exposure);
        const std::vector<float> b = tone_mapped(test, exposure);
        const std::vector<float> map = flip_map({a, reference.width, reference.height},
                                                {b, test.width, test.height}, pixels_per_degree);
        for (std::size_t k = 0; k < map.size(); ++k) largest[k] = std::max(largest[k], map[k]);
    }
    return with_mean(std::move(largest));
}

}  // namespace weft
