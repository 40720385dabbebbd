// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_POSE_SCENE_H
#define WEFT_SCENE_POSE_SCENE_H

#include "scene/scene.h"

namespace weft {

/// Whether any instance is deformed, or it or a light is carried by a node that moves.
[[nodiscard]] bool is_animated(const Scene& scene);

/// Keeps everything in the scene at rest, except cameras.
void hold_still(Scene& scene);

/// Sets `posed`, a copy of the scene `rest`, to its state at `time`, seconds, before any edits: its
/// instances, the meshes that are deformed, lights and materials. Transforms and vertices may be
/// unusable: see validate_pose.
void pose_scene(const Scene& rest, double time, Scene& posed);

}  // namespace weft

#endif
