// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_SCALING_LEAST_SQUARES_H
#define WEFT_BENCH_SCALING_LEAST_SQUARES_H

#include <optional>
#include <span>

namespace weft::bench {

/// y = offset + slope x.
struct LineFit {
    double offset = 0.0;
    double slope = 0.0;

    [[nodiscard]] double at(double x) const { return offset + slope * x; }
};

/// y = factor x^exponent.
struct PowerFit {
    double factor = 0.0;
    double exponent = 0.0;

    [[nodiscard]] double at(double x) const;
};

/// Amdahl's law: y = single (serial + (1 - serial) / n) on n threads.
struct AmdahlFit {
    double single = 0.0;  ///< on one thread
    double serial = 0.0;  ///< share of it that no further thread makes faster; below 0 where
                          ///< threads gain more than their number

    [[nodiscard]] double at(double threads) const;
};

/// The line of least squared relative errors, sum of (fit / y - 1)^2: times that differ by orders
/// of magnitude count alike. None for fewer than two different x, or where a y is not above 0.
/// Throws Error (exit code 3) where the lists differ in length.
[[nodiscard]] std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y);

/// The power law of least squared differences of logarithms. None for fewer than two different x,
/// or where an x or y is not above 0. Throws as above.
[[nodiscard]] std::optional<PowerFit> fit_power(std::span<const double> x,
                                                std::span<const double> y);

/// The law of least squared relative errors. None for fewer than two different numbers of threads,
/// or where a number or y is not above 0. Throws as above.
[[nodiscard]] std::optional<AmdahlFit> fit_amdahl(std::span<const double> threads,
                                                  std::span<const double> y);

/// Root of the mean squared relative error, (expected / y - 1)^2, of values that are above 0; 0 for
/// none. Throws as above.
[[nodiscard]] double relative_rms(std::span<const double> expected, std::span<const double> y);

}  // namespace weft::bench

#endif
