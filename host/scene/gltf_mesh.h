// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_MESH_H
#define WEFT_SCENE_GLTF_MESH_H

#include <cstddef>
#include <optional>

#include "scene/gltf_data.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_report.h"
#include "scene/scene.h"

namespace weft {

/// Reads one primitive of a glTF mesh: only the vertices its triangles use, in their order in the
/// file. Nothing is returned (with a warning) for primitives without triangles. `triangles_read`
/// counts the triangles of the whole file against `limits::max_triangles`. Throws Error (exit
/// code 2).
[[nodiscard]] std::optional<Mesh> read_gltf_primitive(GltfData& data, const GltfValue& primitive,
                                                      const GltfSurface& surface,
                                                      GltfReport& report,
                                                      std::size_t& triangles_read);

}  // namespace weft

#endif
