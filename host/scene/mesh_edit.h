// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MESH_EDIT_H
#define WEFT_SCENE_MESH_EDIT_H

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace weft {

/// Reflects positions and normals in the plane x = 0. Triangles keep their order of corners, so
/// that they face the other way relative to the mesh.
void mirror_mesh(Mesh& mesh);

/// Reverses the order of corners of every triangle.
void reverse_triangles(Mesh& mesh);

/// Reverses the triangles whose geometric normal points against their shading normals.
void orient_by_normals(Mesh& mesh);

/// Sets smooth shading normals: face normals weighted with the angle at the vertex, as they are
/// after the linear transform `to_world`, which must be invertible.
void add_smooth_normals(Mesh& mesh, const glm::dmat3& to_world);

/// Gives every triangle its own vertices with uv (0,0), (1,0) and (0,1). False, with the mesh as
/// it was, when that makes more vertices than a mesh may have.
[[nodiscard]] bool add_barycentric_uvs(Mesh& mesh);

/// Applies an affine map to (u, v, 1) of the texture coordinates of the diffuse surface.
void transform_uvs(Mesh& mesh, const glm::dmat3& to_uv);

/// Whether all vertices stay within `limits::max_coordinate` after the transform.
[[nodiscard]] bool is_within_limits(const Mesh& mesh, const glm::dmat4& to_world);

}  // namespace weft

#endif
