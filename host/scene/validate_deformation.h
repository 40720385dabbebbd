// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_VALIDATE_DEFORMATION_H
#define WEFT_SCENE_VALIDATE_DEFORMATION_H

#include "scene/scene.h"

namespace weft {

/// The part of validate_scene that is about skins and deformations: that all they refer to is
/// there, that numbers of vertices, targets, weights and joints agree, and that numbers are finite.
/// Meshes and tracks have been validated. Throws Error (exit code 2) that names the object.
void validate_deformations(const Scene& scene);

}  // namespace weft

#endif
