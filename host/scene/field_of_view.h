// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_FIELD_OF_VIEW_H
#define WEFT_SCENE_FIELD_OF_VIEW_H

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace weft {

/// Tangent of half the vertical field of view; `aspect`: width of the image over its height.
[[nodiscard]] inline double vertical_tangent(const Camera& camera, double aspect) {
    const double tangent = std::tan(0.5 * camera.fov);
    switch (camera.fov_axis) {
        case FovAxis::y:
            return tangent;
        case FovAxis::x:
            return tangent / aspect;
        case FovAxis::smaller:
            return aspect >= 1.0 ? tangent : tangent / aspect;
        case FovAxis::larger:
            return aspect >= 1.0 ? tangent / aspect : tangent;
        case FovAxis::diagonal:
            return tangent / std::sqrt(1.0 + aspect * aspect);
    }
    return tangent;
}

/// Half the height of what an orthographic camera shows, in scene units; `aspect` as above.
[[nodiscard]] inline double half_height(const Camera& camera, double aspect) {
    return std::max(camera.half_extent.y, camera.half_extent.x / aspect);
}

/// The way a camera looks, of length 1.
[[nodiscard]] inline glm::dvec3 viewing_axis(const Camera& camera) {
    return glm::normalize(-glm::dvec3(camera.to_world[2]));
}

/// Where the ray through the middle of the image begins.
[[nodiscard]] inline glm::dvec3 ray_start(const Camera& camera) {
    const glm::dvec3 position(camera.to_world[3]);
    return camera.orthographic() ? position + camera.near_plane * viewing_axis(camera) : position;
}

}  // namespace weft

#endif
