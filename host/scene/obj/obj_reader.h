// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_OBJ_OBJ_READER_H
#define WEFT_SCENE_OBJ_OBJ_READER_H

#include <filesystem>
#include <string>

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace weft {

/// Reads a Wavefront OBJ file with its MTL files: one mesh and instance for each material. Polygons
/// are cut into triangles, concave ones too. What Weft does not simulate, and materials and
/// images that are missing, are named once in `diagnostics`. Of materials as much is read as
/// `detail` says. Throws Error (exit code 2) with `file:line` for anything broken.
[[nodiscard]] Scene read_obj(const std::filesystem::path& path, Diagnostics& diagnostics,
                             MaterialDetail detail = MaterialDetail::full);

/// Reads all faces of an OBJ file as one mesh, without materials and vertex colours. Texture
/// coordinate v is turned to run downwards where `flip_v`. `place` is where the file is referred
/// to, for a file that cannot be read. Throws Error (exit code 2).
[[nodiscard]] Mesh read_obj_mesh(const std::filesystem::path& path, const std::string& place,
                                 bool flip_v, Diagnostics& diagnostics);

}  // namespace weft

#endif
