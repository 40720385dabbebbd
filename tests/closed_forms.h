// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_CLOSED_FORMS_H
#define WEFT_TESTS_CLOSED_FORMS_H

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace weft::test {

/// Irradiance of a polygon of radiance 1 that lies above the receiver's horizon (Lambert).
inline double polygon_irradiance(const std::vector<glm::dvec3>& corners, const glm::dvec3& point,
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

/// Mean of independent estimates and its standard error.
struct Estimate {
    double mean = 0.0;
    double error = 0.0;
};

/// From at least two values.
inline Estimate estimate(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    Estimate result;
    for (const double value : values) result.mean += value / n;
    double square = 0.0;
    for (const double value : values) square += (value - result.mean) * (value - result.mean);
    result.error = std::sqrt(square / (n * (n - 1.0)));
    return result;
}

}  // namespace weft::test

#endif
