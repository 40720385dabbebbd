// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/hdr_vdp_grid.h"

#include <algorithm>

namespace weft {

Filter::Filter(const FrequencyGrid& grid)
    : grid_(grid),
      weights_(std::size_t{grid.columns()} * grid.height, 1.0),
      reach_(grid.columns() - 1) {}

// Both signs of the vertical frequency are in this column. Their weights must agree for the
// filtered map to be real; a transform back to real values uses the mean of two that do not.
void Filter::make_symmetric(std::uint32_t column) {
    for (std::uint32_t row = 1; row < grid_.height - row; ++row) {
        double& weight = (*this)(column, row);
        double& opposite = (*this)(column, grid_.height - row);
        weight = opposite = 0.5 * (weight + opposite);
    }
}

void Filter::finish() {
    make_symmetric(0);
    if (grid_.width % 2 == 0) make_symmetric(grid_.width / 2);
    reach_ = 0;
    for (std::uint32_t row = 0; row < grid_.height; ++row)
        for (std::uint32_t column = grid_.columns(); column-- > reach_ + 1;)
            if ((*this)(column, row) != 0.0) reach_ = column;
}

double Filter::largest() const {
    return *std::max_element(weights_.begin(), weights_.end());
}

void Filter::apply(std::span<const std::complex<double>> spectrum,
                   std::span<std::complex<double>> output) const {
    const std::size_t width = grid_.width;
    const std::size_t columns = grid_.columns();
    for (std::size_t row = 0; row < grid_.height; ++row) {
        const std::size_t opposite_row = row == 0 ? 0 : grid_.height - row;
        const double* near = &weights_[row * columns];
        const double* far = &weights_[opposite_row * columns];
        for (std::size_t x = 0; x < columns; ++x)
            output[row * width + x] = spectrum[row * width + x] * near[x];
        for (std::size_t x = columns; x < width; ++x)
            output[row * width + x] = spectrum[row * width + x] * far[width - x];
    }
}

}  // namespace weft
