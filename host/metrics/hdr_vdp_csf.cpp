// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/hdr_vdp_csf.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

constexpr double accommodation = 0.9;
constexpr double image_area = 1.0;         // square degrees
constexpr double largest_exponent = 50.0;  // sensitivity is negligible, exp() still finite

double straight_sensitivity(double frequency, double adaptation) {
    const double a = 0.801 * std::pow(1.0 + 0.7 / adaptation, -0.2);
    const double b = 0.3 * std::pow(1.0 + 100.0 / adaptation, 0.15);
    const double exponent = b * accommodation * frequency;
    if (frequency <= 0.0 || exponent > largest_exponent) return 0.0;
    const double extent = std::pow(3.23 * std::pow(frequency * frequency * image_area, -0.3), 5.0);
    return std::pow(extent + 1.0, -0.2) * a * accommodation * frequency * std::exp(-exponent) *
           std::sqrt(1.0 + 0.06 * std::exp(exponent));
}

}  // namespace

double contrast_sensitivity(double frequency, double angle, double adaptation, double distance) {
    const double accommodated = 0.856 * std::pow(distance, 0.14);
    const double oblique = 0.11 * std::cos(4.0 * angle) + 0.89;
    return std::min(straight_sensitivity(frequency / (accommodated * oblique), adaptation),
                    straight_sensitivity(frequency, adaptation));
}

Filter neural_filter(const FrequencyGrid& grid, const Filter& optics, double pixels_per_degree,
                     double adaptation, double distance) {
    Filter filter(grid, [&](std::uint32_t column, std::uint32_t row) {
        const double x = grid.x(column);
        const double y = grid.y(row);
        return contrast_sensitivity(std::hypot(x, y) * pixels_per_degree, std::atan2(y, x),
                                    adaptation, distance);
    });
    const double peak = filter.largest();
    return Filter(grid, [&](std::uint32_t column, std::uint32_t row) {
        const double sensitivity = filter(column, row);
        return sensitivity > 0.0 ? std::min(sensitivity / peak / optics(column, row), 1.0) : 0.0;
    });
}

double adaptation_weight(std::size_t level, double adaptation) {
    const double clamped =
        std::clamp(adaptation, adaptation_levels.front(), adaptation_levels.back());
    const double here = adaptation_levels[level];
    if (clamped < here) {
        const double below = level == 0 ? here : adaptation_levels[level - 1];
        return clamped <= below ? 0.0 : (clamped - below) / (here - below);
    }
    if (level + 1 == adaptation_levels.size()) return 1.0;
    const double above = adaptation_levels[level + 1];
    return clamped >= above ? 0.0 : (above - clamped) / (above - here);
}

}  // namespace weft
