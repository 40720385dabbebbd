// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_INFLUENCES_H
#define WEFT_SCENE_GLTF_GLTF_INFLUENCES_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/warning_collector.h"
#include "scene/deformation.h"
#include "scene/gltf/gltf_data.h"

namespace weft {

/// Whether joints carry all parts of a mesh: each of its primitives of triangles has JOINTS_0 and
/// WEIGHTS_0.
[[nodiscard]] bool is_skinnable(const JsonValue& mesh);

/// The joints of a primitive's vertices and their weights, for the given ones of its `vertex_count`
/// vertices. Weights that are negative or not finite become 0, and the others are divided by their
/// sum; a vertex without any follows its first joint. `influences_read` grows by what is read, up
/// to limits::max_joint_influences. Throws Error (exit code 2).
[[nodiscard]] JointInfluences read_gltf_influences(GltfData& data, const JsonValue& attributes,
                                                   std::size_t vertex_count,
                                                   const std::vector<std::uint32_t>& vertices,
                                                   WarningCollector& report,
                                                   std::size_t& influences_read);

}  // namespace weft

#endif
