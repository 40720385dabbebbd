// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_CAMERA_PLACEMENT_H
#define WEFT_RENDER_CAMERA_PLACEMENT_H

#include <glm/vec3.hpp>
#include <optional>

#include "scene/scene.h"

namespace weft {

/// Where a camera stands and what it points at, in scene units.
struct CameraView {
    glm::dvec3 from{0.0};
    glm::dvec3 at{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< what is upwards in the image; of any length above 0
};

/// What is to be different of a camera; what is empty stays.
struct CameraPlacement {
    std::optional<CameraView> view;
    std::optional<double> fov;  ///< degrees, along the axis that the camera has it along
};

/// Whether a camera can point that way: the points differ, and `up` is not along the view.
[[nodiscard]] bool can_point(const CameraView& view);

/// The camera with that placement. One with a view stands still in animations. `placement.view`
/// satisfies can_point. Throws Error (exit code 1) where an orthographic camera is to get a field
/// of view.
[[nodiscard]] Camera placed_camera(const Camera& camera, const CameraPlacement& placement);

}  // namespace weft

#endif
