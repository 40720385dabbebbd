// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/closed_forms.h"

#include <cmath>
#include <cstddef>

namespace weft::selftest {

double polygon_irradiance(const std::vector<glm::dvec3>& corners, const glm::dvec3& point,
                          const glm::dvec3& normal) {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - point);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - point);
        const glm::dvec3 c = glm::cross(a, b);
        const double sine = glm::length(c);
        sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(c / sine, normal);
    }
    return 0.5 * std::abs(sum);
}

}  // namespace weft::selftest
