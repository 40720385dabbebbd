// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_TANGENTS_H
#define WEFT_SCENE_TANGENTS_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace weft {

/// The tangents of a mesh. Where one vertex belongs to triangles whose textures are mirrored
/// against each other it needs two, so that some vertices are there twice: the mesh is to get
/// copies of those in `copies` behind its own vertices, and `triangles` in place of its own.
struct MeshTangents {
    /// By vertex, the copies included: xyz is a unit vector along which u grows, and w, 1 or -1, is
    /// such that w (N x T) points to where v falls: up in the image of a texture.
    std::vector<glm::vec4> tangents;
    std::vector<std::uint32_t> copies;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Makes the tangents that normal maps are baked for, by the rules of MikkTSpace (Mikkelsen 2008)
/// for triangles, from texture coordinates `uvs`, one a vertex; without them, or where they tell
/// nothing, a tangent is any vector across the normal. Without normals those of triangles are used.
[[nodiscard]] MeshTangents make_tangents(const Mesh& mesh, const std::vector<glm::vec2>& uvs);

}  // namespace weft

#endif
