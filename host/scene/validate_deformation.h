// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_VALIDATE_DEFORMATION_H
#define WEFT_SCENE_VALIDATE_DEFORMATION_H

#include "scene/scene.h"

namespace weft {

/// The part of validate_scene for skins and deformations: checks that everything they refer to
/// exists, that counts of vertices, targets, weights and joints agree, and that numbers are finite.
/// Meshes and tracks have been validated. Throws Error (exit code 2) that names the object.
void validate_deformations(const Scene& scene);

}  // namespace weft

#endif
