// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_LOAD_LOAD_SCENE_H
#define WEFT_SCENE_LOAD_LOAD_SCENE_H

#include <filesystem>

#include "base/diagnostics.h"
#include "scene/default_light.h"
#include "scene/scene.h"

namespace weft {

/// How a scene file is read: what lights it besides what it says, and how much of its materials.
struct SceneReading {
    DefaultLight light = DefaultLight::as_needed;
    /// An image in place of the environment of the file; empty: none.
    std::filesystem::path environment{};
    /// How far the image of the environment, that one or the file's, is turned about +y, degrees.
    double environment_rotation = 0.0;
    MaterialDetail materials = MaterialDetail::full;
};

/// Reads `.gltf`, `.glb` (glTF 2.0), `.xml` (Mitsuba 3 subset), `.obj` (Wavefront OBJ with MTL) or
/// `.ply` (one mesh), of materials as much as `reading` says, and adds light by it. What the file
/// asks for and Weft does not simulate is named once in `diagnostics`. Throws Error (exit code 2)
/// with file and place for anything broken.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                               const SceneReading& reading = {});

}  // namespace weft

#endif
