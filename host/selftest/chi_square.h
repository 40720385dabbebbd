// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_CHI_SQUARE_H
#define WEFT_SELFTEST_CHI_SQUARE_H

#include <cstddef>
#include <vector>

namespace weft::selftest {

/// A chi-square value with `freedom` degrees of freedom as a standard normal variable: its cube
/// root is nearly normal (Wilson and Hilferty 1931).
[[nodiscard]] double normal_of(double chi_square, double freedom);

/// Counts points by bins of known probabilities.
class Histogram {
  public:
    static constexpr std::size_t rows = 64;
    static constexpr std::size_t columns = 128;

    explicit Histogram(std::size_t bins) : counts_(bins) {}
    Histogram() : Histogram(rows * columns) {}

    /// Counts a point of the unit square. Throws std::out_of_range where it lies outside.
    void add(double u, double v);
    void add(std::size_t bin) { counts_.at(bin) += 1.0; }

    /// The normal variable of these counts, for bins of equal probability.
    [[nodiscard]] double normal() const;
    [[nodiscard]] double normal(const std::vector<double>& probabilities) const;

  private:
    std::vector<double> counts_;
};

/// Angle of a vector as a share of the circle, [0, 1].
[[nodiscard]] double turn(double x, double y);

}  // namespace weft::selftest

#endif
