// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/hdr_vdp_cortex.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double fan_spacing = pi / CortexTransform::orientation_count;

// Low-pass filter with half its height at 2^-octave cycles per pixel.
double mesa(unsigned octave, double radius) {
    const double half = std::ldexp(1.0, -static_cast<int>(octave));
    const double transition = half * 2.0 / 3.0;
    if (radius < half - transition / 2.0) return 1.0;
    if (radius > half + transition / 2.0) return 0.0;
    return 0.5 * (1.0 + std::cos(pi * (radius - half + transition / 2.0) / transition));
}

double base(double radius) {
    constexpr double end = 1.0 / 24.0;
    constexpr double deviation = end / 3.0;
    return radius < end ? std::exp(-radius * radius / (2.0 * deviation * deviation)) : 0.0;
}

double octave_band(unsigned band, double radius) {
    const bool lowest = band + 2 == CortexTransform::band_count;
    const double below = lowest ? base(radius) : mesa(band + 1, radius);
    return std::max(mesa(band, radius) - below, 0.0);
}

double fan(double angle, double centre) {
    double offset = std::abs(angle - centre);
    if (offset >= pi / 2.0) offset = pi - offset;
    return std::abs(offset) < fan_spacing ? 0.5 * (1.0 + std::cos(pi * offset / fan_spacing)) : 0.0;
}

}  // namespace

CortexTransform::CortexTransform(const FrequencyGrid& grid, bool legacy_fan)
    : grid_(grid), radius_(std::size_t{grid.columns()} * grid.height), angle_(radius_.size()) {
    for (std::uint32_t row = 0; row < grid.height; ++row) {
        const double y = grid.y(row);
        const double fan_y = legacy_fan && y < 0.0 ? y + 1.0 / grid.height : y;
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            radius_[index(column, row)] = std::hypot(grid.x(column), y);
            angle_[index(column, row)] = std::atan2(fan_y, grid.x(column));
        }
    }
}

Filter CortexTransform::channel(unsigned band, unsigned orientation) const {
    if (band + 1 == band_count) return phase_spread(band);
    const double centre = pi / 2.0 - orientation * fan_spacing;
    return Filter(grid_, [&](std::uint32_t column, std::uint32_t row) {
        if (column == 0 && row == 0) return 0.0;
        const std::size_t bin = index(column, row);
        const double octave = octave_band(band, radius_[bin]);
        return octave > 0.0 ? octave * fan(angle_[bin], centre) : 0.0;
    });
}

Filter CortexTransform::phase_spread(unsigned band) const {
    return Filter(grid_, [&](std::uint32_t column, std::uint32_t row) {
        const double radius = radius_[index(column, row)];
        return band + 1 == band_count ? base(radius) : mesa(band, radius);
    });
}

}  // namespace weft
