// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/camera_placement.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "base/error.h"
#include "base/finite.h"
#include "base/quote.h"

namespace weft {
namespace {

/// Of length 1, also where the square of the length is more or less than doubles hold; 0 where the
/// vector is 0.
glm::dvec3 direction_of(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0)) return glm::dvec3(0.0);
    return glm::normalize(v / largest);
}

}  // namespace

bool can_point(const CameraView& view) {
    if (!is_finite(view.from) || !is_finite(view.at) || !is_finite(view.up)) return false;
    const glm::dvec3 backward = direction_of(view.from - view.at);
    // Below this, rounding decides which side is up.
    constexpr double least_sine = 1e-6;
    return is_finite(backward) &&
           glm::length(glm::cross(direction_of(view.up), backward)) > least_sine;
}

Camera placed_camera(const Camera& camera, const CameraPlacement& placement) {
    Camera placed = camera;
    if (placement.fov) {
        if (camera.orthographic())
            throw Error(ExitCode::usage, "--fov: camera " + quote(camera.name) +
                                             " is orthographic, expected one with perspective");
        placed.fov = glm::radians(*placement.fov);
    }
    if (!placement.view) return placed;
    const CameraView& view = *placement.view;
    const glm::dvec3 backward = direction_of(view.from - view.at);
    const glm::dvec3 right = glm::normalize(glm::cross(direction_of(view.up), backward));
    const glm::dvec3 up = glm::cross(backward, right);
    placed.to_world = glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(up, 0.0),
                                 glm::dvec4(backward, 0.0), glm::dvec4(view.from, 1.0));
    placed.mirror_x = false;
    placed.motion = {};
    return placed;
}

}  // namespace weft
