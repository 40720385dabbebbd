// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_PLACED_SCENE_H
#define WEFT_SELFTEST_PLACED_SCENE_H

#include <cstddef>
#include <glm/glm.hpp>

#include "scene/scene.h"
#include "selftest/rendering.h"

namespace weft::selftest {

/// A room with a ball, area, point, spot and directional light, scaled and moved as a whole.
/// Radiance stays the same where intensities grow with the square of the scale.
struct Placed {
    Scene scene;
    Camera camera;
};

[[nodiscard]] Placed placed_scene(double scale, const glm::dvec3& move);

/// Number of isolated dark pixels: below half of their reference while all neighbours are not.
[[nodiscard]] std::size_t isolated_dark_pixels(const Rendering& reference, const Rendering& test);

}  // namespace weft::selftest

#endif
