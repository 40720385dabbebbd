// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_FINITE_H
#define WEFT_BASE_FINITE_H

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace weft {

/// Whether all components of a vector are finite.
template <int N, typename T>
[[nodiscard]] bool is_finite(const glm::vec<N, T>& vector) {
    for (int i = 0; i < N; ++i)
        if (!std::isfinite(vector[i])) return false;
    return true;
}

/// Whether all numbers of a transform are finite.
[[nodiscard]] inline bool is_finite(const glm::dmat4& transform) {
    for (int column = 0; column < 4; ++column)
        if (!is_finite(transform[column])) return false;
    return true;
}

/// Whether all vectors or transforms of a range are finite.
template <class Range>
[[nodiscard]] bool all_finite(const Range& range) {
    return std::all_of(range.begin(), range.end(), [](const auto& one) { return is_finite(one); });
}

}  // namespace weft

#endif
