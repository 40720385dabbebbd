// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_MESH_H
#define WEFT_SCENE_GLTF_GLTF_MESH_H

#include <cstddef>
#include <optional>

#include "base/warning_collector.h"
#include "scene/deformation.h"
#include "scene/gltf/gltf_data.h"
#include "scene/gltf/gltf_materials.h"
#include "scene/scene.h"

namespace weft {

/// A primitive of a glTF mesh.
struct GltfPrimitive {
    Mesh mesh;
    std::optional<MeshShape> shape{};  ///< what it is deformed from, where GltfForms requires it
};

/// Which deformations of a primitive to read.
struct GltfForms {
    bool skinned = false;
    bool morphed = false;
};

/// How much has been read of a file, for comparison with limits.
struct GltfCounts {
    std::size_t triangles = 0;
    std::size_t deltas = 0;      ///< displacements by morph targets
    std::size_t influences = 0;  ///< of joints on vertices
};

/// Reads one primitive of a glTF mesh: only the vertices its triangles use, in their order in the
/// file. Nothing is returned (with a warning) for primitives without triangles. `read` grows with
/// what is read, up to `limits::max_triangles`, `limits::max_morph_deltas` and
/// `limits::max_joint_influences`. Throws Error (exit code 2).
[[nodiscard]] std::optional<GltfPrimitive> read_gltf_primitive(
    GltfData& data, const JsonValue& primitive, const GltfSurface& surface, const GltfForms& forms,
    WarningCollector& report, GltfCounts& read);

}  // namespace weft

#endif
