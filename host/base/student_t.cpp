// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/student_t.h"

#include <cmath>
#include <numbers>

namespace weft {

double student_t_coverage(double t, std::uint32_t degrees) {
    const double angle = std::atan(t / std::sqrt(static_cast<double>(degrees)));
    const double cosine = std::cos(angle);
    const bool odd = degrees % 2 == 1;
    double term = odd ? cosine : 1.0;
    double sum = degrees == 1 ? 0.0 : term;
    for (std::uint32_t k = odd ? 3 : 2; k + 1 < degrees; k += 2) {
        term *= cosine * cosine * (k - 1.0) / k;
        sum += term;
    }
    sum *= std::sin(angle);
    return odd ? 2.0 / std::numbers::pi * (angle + sum) : sum;
}

double student_t_quantile(double coverage, std::uint32_t degrees) {
    double low = 0.0;
    double high = 1.0;
    while (student_t_coverage(high, degrees) < coverage) high *= 2.0;
    constexpr int halvings = 60;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (student_t_coverage(middle, degrees) < coverage ? low : high) = middle;
    }
    return high;
}

}  // namespace weft
