// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_VALIDATE_SCENE_H
#define WEFT_SCENE_VALIDATE_SCENE_H

#include "scene/scene.h"

namespace weft {

/// The last check before a scene is rendered, whoever made it: indices in range, attribute arrays
/// of equal length, numbers finite, transforms invertible, world coordinates within
/// `limits::max_coordinate`, all placed triangles within `limits::max_triangles`. Throws Error
/// (exit code 2) that names the object.
void validate_scene(const Scene& scene);

/// Checks the transform of a camera of the scene at some other time, which `when` names. Throws
/// Error (exit code 2).
void validate_camera(const Scene& scene, const Camera& camera, const std::string& when);

/// Checks what may differ from the scene at rest at some other time, which `when` names: the places
/// of instances that may move, the vertices of those that are deformed, lights and materials. The
/// scene at rest has been validated. Throws Error (exit code 2).
void validate_pose(const Scene& scene, const std::string& when);

}  // namespace weft

#endif
