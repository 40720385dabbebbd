// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_STUDENT_T_H
#define WEFT_BASE_STUDENT_T_H

#include <cstdint>

namespace weft {

/// Probability that a variable with Student's t distribution lies in [-t, t], t >= 0, of `degrees`
/// degrees of freedom, 1 and up (Abramowitz and Stegun 26.7.3 and 26.7.4). Takes time in proportion
/// to the degrees.
[[nodiscard]] double student_t_coverage(double t, std::uint32_t degrees);

/// The t for which student_t_coverage is `coverage`, in (0, 1).
[[nodiscard]] double student_t_quantile(double coverage, std::uint32_t degrees);

}  // namespace weft

#endif
