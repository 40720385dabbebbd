// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_CLOSED_FORMS_H
#define WEFT_SELFTEST_CLOSED_FORMS_H

#include <glm/glm.hpp>
#include <vector>

namespace weft::selftest {

/// Irradiance of a polygon of radiance 1 that lies above the receiver's horizon (Lambert 1760).
[[nodiscard]] double polygon_irradiance(const std::vector<glm::dvec3>& corners,
                                        const glm::dvec3& point, const glm::dvec3& normal);

/// Form factor of two parallel unit squares at distance 1 (Howell's catalogue, C-11).
inline constexpr double parallel_form_factor = 0.1998248957;
/// Form factor of two perpendicular unit squares with a common edge (Howell's catalogue, C-14).
inline constexpr double perpendicular_form_factor = 0.2000437761;

/// Radiance of single scattering in an infinite medium (Sun et al. 2005): extinction 0.3, albedo 1,
/// isotropic; a point light of intensity 2 lies 1.5 away at 0.9 rad from the ray, which ends
/// after 4.
inline constexpr double sun_airlight = 0.03389058698;

}  // namespace weft::selftest

#endif
