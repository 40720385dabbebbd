// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_POSE_JSON_H
#define WEFT_SCENE_POSE_JSON_H

#include <glm/glm.hpp>

#include "base/json_value.h"
#include "scene/animation.h"

namespace weft {

/// Reads translation, rotation and scale of a node, each where it is given. Throws Error (exit code
/// 2) where the rotation is far from unit length.
[[nodiscard]] Pose read_pose(const JsonValue& node);

/// Reads the `matrix` of an object, 16 numbers by columns; the identity where there is none. Throws
/// Error (exit code 2) where it is not affine.
[[nodiscard]] glm::dmat4 read_matrix(const JsonValue& value);

}  // namespace weft

#endif
