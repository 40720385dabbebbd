// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/chi_square.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace weft::selftest {

double normal_of(double chi_square, double freedom) {
    const double spread = 2.0 / (9.0 * freedom);
    return (std::cbrt(chi_square / freedom) - (1.0 - spread)) / std::sqrt(spread);
}

void Histogram::add(double u, double v) {
    if (!(u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0))
        throw std::out_of_range("a sample lies outside of the unit square");
    const auto row = std::min(static_cast<std::size_t>(u * rows), rows - 1);
    const auto column = std::min(static_cast<std::size_t>(v * columns), columns - 1);
    add(row * columns + column);
}

double Histogram::normal() const {
    return normal(std::vector<double>(counts_.size(), 1.0 / static_cast<double>(counts_.size())));
}

double Histogram::normal(const std::vector<double>& probabilities) const {
    double total = 0.0;
    for (const double count : counts_) total += count;
    double chi_square = 0.0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        const double expected = total * probabilities[i];
        chi_square += (counts_[i] - expected) * (counts_[i] - expected) / expected;
    }
    return normal_of(chi_square, static_cast<double>(counts_.size() - 1));
}

double turn(double x, double y) {
    return std::min(1.0, std::atan2(y, x) / (2.0 * std::numbers::pi) + 0.5);
}

}  // namespace weft::selftest
