// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_EMISSION_MEANS_H
#define WEFT_SCENE_EMISSION_MEANS_H

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace weft {

/// Texture coordinates by which a mesh looks up the texture of its emission, one a vertex; or
/// empty.
[[nodiscard]] inline const std::vector<glm::vec2>& emission_uvs(const Mesh& mesh) {
    return mesh.emission_uvs.empty() ? mesh.uvs : mesh.emission_uvs;
}

/// Mean linear colour of a texture over each triangle of a mesh, to within a few percent where
/// texels are smaller than triangles. It is above 0 wherever a look-up of single texels is above 0
/// anywhere on the triangle: light samples find all that shines.
[[nodiscard]] std::vector<glm::vec3> emission_means(const Mesh& mesh, const Texture& texture);

}  // namespace weft

#endif
