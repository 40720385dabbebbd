// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/transform.h"

#include <cmath>

namespace weft {

bool is_singular(const glm::dmat4& transform) {
    constexpr double flat = 1e-14;
    const glm::dmat3 linear(transform);
    const double volume = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    return !(std::abs(glm::determinant(linear)) > flat * volume);
}

}  // namespace weft
