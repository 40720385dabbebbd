// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_LOAD_LOAD_SCENE_H
#define WEFT_SCENE_LOAD_LOAD_SCENE_H

#include <filesystem>

#include "base/diagnostics.h"
#include "scene/default_light.h"
#include "scene/scene.h"

namespace weft {

/// Reads `.gltf`, `.glb` (glTF 2.0), `.xml` (Mitsuba 3 subset), `.obj` (Wavefront OBJ with MTL) or
/// `.ply` (one mesh), of materials as much as `detail` says, and adds the default light by `light`.
/// What the file asks for and Weft does not simulate is named once in `diagnostics`. Throws Error
/// (exit code 2) with file and place for anything broken.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                               DefaultLight light = DefaultLight::as_needed,
                               MaterialDetail detail = MaterialDetail::full);

}  // namespace weft

#endif
