// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MESH_TANGENTS_H
#define WEFT_SCENE_MESH_TANGENTS_H

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace weft {

/// The set of texture coordinates, an index into Mesh::uv_sets, by which meshes of a surface get
/// their tangents: that of its normal map, or of what else has a direction. None where nothing has.
[[nodiscard]] std::optional<std::uint32_t> tangent_uv_set(const SurfaceDescription& surface);

/// Gives a mesh its tangents (make_tangents), in place of those that it has. Vertices that need two
/// are copied to the end; returns which, in order.
std::vector<std::uint32_t> add_tangents(Mesh& mesh, std::uint32_t uv_set);

/// Gives tangents to those meshes of a scene that have none, keep their form and are placed with a
/// surface that asks for them.
void add_missing_tangents(Scene& scene);

}  // namespace weft

#endif
