// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_TOLERANCE_H
#define WEFT_SELFTEST_TOLERANCE_H

#include <cstddef>
#include <string>

namespace weft::selftest {

/// Probability with which a correct renderer would miss a stochastic check, were its seed not
/// fixed.
inline constexpr double false_alarm = 1e-5;

/// How far a measured value may be from the expected one.
struct Tolerance {
    double absolute = 0.0;       ///< in units of the value
    double relative = 0.0;       ///< share of the expected value
    double largest_error = 0.0;  ///< of estimates: largest standard error, likewise; 0: no estimate
    /// Of estimates: number of independent values that the standard error is estimated from; 0: so
    /// many that it counts as known.
    std::size_t seeds = 0;
};

/// An absolute tolerance, in units of the value.
[[nodiscard]] constexpr Tolerance within(double absolute) {
    return {absolute, 0.0, 0.0, 0};
}

/// A tolerance relative to the expected value.
[[nodiscard]] constexpr Tolerance share(double relative) {
    return {0.0, relative, 0.0, 0};
}

/// The deviation that chance keeps to with the probability 1 - false_alarm, on top of the relative
/// error of model and floats.
[[nodiscard]] constexpr Tolerance by_chance(double largest_error, double relative,
                                            std::size_t seeds = 0) {
    return {0.0, relative, largest_error, seeds};
}

/// By how many standard errors an estimate may be off.
[[nodiscard]] double standard_errors(const Tolerance& tolerance);

/// The distance from `expected` that is allowed of a value with this standard error.
[[nodiscard]] double allowed(const Tolerance& tolerance, double expected, double error);

/// The tolerance in words, for the ledger: the same on every machine.
[[nodiscard]] std::string to_string(const Tolerance& tolerance);

}  // namespace weft::selftest

#endif
