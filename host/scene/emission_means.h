// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_EMISSION_MEANS_H
#define WEFT_SCENE_EMISSION_MEANS_H

#include <glm/glm.hpp>
#include <vector>

#include "scene/mip_levels.h"
#include "scene/scene.h"

namespace weft {

/// Texture coordinates by which a mesh looks up the texture of its emission, one a vertex; or
/// empty.
[[nodiscard]] inline const std::vector<glm::vec2>& emission_uvs(const Mesh& mesh) {
    return mesh.emission_uvs.empty() ? mesh.uvs : mesh.emission_uvs;
}

/// Measures the emission of a scene's meshes. It keeps the averages of the last texture, which the
/// instances of a model share.
class EmissionMeans {
  public:
    /// The scene must outlive this.
    explicit EmissionMeans(const Scene& scene) : scene_(scene) {}

    /// Mean linear colour of texture `number` of the scene over each triangle of a mesh, to within
    /// a few percent where texels are smaller than triangles. It is above 0 wherever a look-up of
    /// single texels is above 0 anywhere on the triangle: light samples find all that shines.
    [[nodiscard]] std::vector<glm::vec3> of(const Mesh& mesh, int number);

  private:
    const Scene& scene_;
    int last_ = -1;
    std::vector<LinearLevel> levels_;  ///< of the last texture
};

}  // namespace weft

#endif
