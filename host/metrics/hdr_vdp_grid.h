// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_HDR_VDP_GRID_H
#define WEFT_METRICS_HDR_VDP_GRID_H

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// The frequencies of the discrete transform of a width x height map (both at least 2). Columns run
/// over the half plane 0 ... width / 2 of horizontal frequencies; the opposite half of a real map's
/// spectrum follows from it. Rows run over all vertical frequencies, the negative ones last.
struct FrequencyGrid {
    std::uint32_t width;
    std::uint32_t height;

    [[nodiscard]] std::uint32_t columns() const { return width / 2 + 1; }

    /// Vertical frequency of a row in cycles per image height, negative in the second half.
    [[nodiscard]] double signed_row(std::uint32_t row) const {
        return row <= height / 2 ? static_cast<double>(row)
                                 : static_cast<double>(row) - static_cast<double>(height);
    }

    /// Horizontal and vertical frequency in cycles per pixel, at most 0.5 in magnitude.
    [[nodiscard]] double x(std::uint32_t column) const {
        return static_cast<double>(column) / static_cast<double>(width);
    }
    [[nodiscard]] double y(std::uint32_t row) const {
        return signed_row(row) / static_cast<double>(height);
    }
};

/// Real weights on the half plane of a FrequencyGrid, row-major. The weight of an opposite
/// frequency is the same.
class Filter {
  public:
    /// All weights 1.
    explicit Filter(const FrequencyGrid& grid);

    /// Calls weight(column, row) for every bin of the half plane.
    template <typename Weight>
    Filter(const FrequencyGrid& grid, const Weight& weight) : Filter(grid) {
        for (std::uint32_t row = 0; row < grid_.height; ++row)
            for (std::uint32_t column = 0; column < grid_.columns(); ++column)
                (*this)(column, row) = weight(column, row);
        finish();
    }

    [[nodiscard]] double& operator()(std::uint32_t column, std::uint32_t row) {
        return weights_[std::size_t{row} * grid_.columns() + column];
    }
    [[nodiscard]] double operator()(std::uint32_t column, std::uint32_t row) const {
        return weights_[std::size_t{row} * grid_.columns() + column];
    }

    /// Largest column with a weight other than 0; 0 where there is none.
    [[nodiscard]] std::uint32_t reach() const { return reach_; }

    [[nodiscard]] double largest() const;

    /// output = spectrum * weights over the whole plane; the two may be the same map.
    void apply(std::span<const std::complex<double>> spectrum,
               std::span<std::complex<double>> output) const;

  private:
    void finish();
    void make_symmetric(std::uint32_t column);

    FrequencyGrid grid_;
    std::vector<double> weights_;
    std::uint32_t reach_;
};

}  // namespace weft

#endif
