// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/hdr_vdp_optics.h"

#include <algorithm>
#include <cmath>

namespace weft {

double pupil_diameter(double luminance) {
    return 4.9 - 3.0 * std::tanh(0.4 * (std::log10(luminance) + 1.0));
}

double optical_transfer(double frequency, double pupil) {
    return std::exp(-std::pow(frequency / (20.9 - 2.1 * pupil), 1.3 - 0.07 * pupil));
}

Filter optics_filter(const FrequencyGrid& grid, double pixels_per_degree, double pupil,
                     bool legacy_grid) {
    const double legacy_x = 0.5 / (grid.width / 2 + 1);
    const double legacy_y = 0.5 / (grid.height / 2 + 1);
    const auto transfer = [&](std::uint32_t column, std::uint32_t row) {
        const double x = legacy_grid ? column * legacy_x : grid.x(column);
        const double y = legacy_grid ? grid.signed_row(row) * legacy_y : grid.y(row);
        return optical_transfer(std::hypot(x, y) * pixels_per_degree, pupil);
    };
    // The formula is not meant for frequency 0, which gets the weight of its better neighbour. The
    // function falls with frequency, so this is also the largest weight.
    const double largest = std::max(transfer(1, 0), transfer(0, 1));
    return Filter(grid, [&](std::uint32_t column, std::uint32_t row) {
        return column == 0 && row == 0 ? 1.0 : transfer(column, row) / largest;
    });
}

}  // namespace weft
