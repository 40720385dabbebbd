// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_ABSORPTION_H
#define WEFT_SCENE_SURFACE_ABSORPTION_H

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace weft {

/// How the inside of a surface absorbs light: white light has `colour` after `distance`.
struct Absorption {
    glm::vec3 colour{1.0F};  ///< [0, 1]
    double distance = 0.0;   ///< scene units; 0: nothing is absorbed
};

/// The absorption coefficient, 1 / scene unit, up to 1e30. Black counts as 2^-24: it absorbs much,
/// but not infinitely.
[[nodiscard]] inline glm::dvec3 sigma_a(const Absorption& inside) {
    glm::dvec3 absorbed(0.0);
    if (!(inside.distance > 0.0)) return absorbed;
    const double least = std::ldexp(1.0, -24);
    constexpr double most = 1e30;
    for (int c = 0; c < 3; ++c) {
        const double left = std::clamp(static_cast<double>(inside.colour[c]), least, 1.0);
        absorbed[c] = std::min(-std::log(left) / inside.distance, most);
    }
    return absorbed;
}

}  // namespace weft

#endif
