// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MEAN_ALBEDO_H
#define WEFT_SCENE_MEAN_ALBEDO_H

#include <glm/glm.hpp>
#include <span>

#include "scene/scene.h"
#include "scene/texture_statistics.h"

namespace weft {

/// The factor in [0, 1] on albedo_texture by which a material reflects light of all directions to
/// all directions. Light paths of previews and what their VPLs light see surfaces as diffuse ones
/// of this albedo: of metals, plastics and glass the diffuse part and what facets reflect, each by
/// its mean. diffuse_albedo where the material is not described. `textures` are by texture of the
/// scene.
[[nodiscard]] glm::vec3 mean_albedo(const Material& material,
                                    std::span<const TextureStatistics> textures);

/// Mean share in [0, 1] of the light that goes on through a material: of gaps, and of glass that it
/// is clear, times its colour. What its inside absorbs is not in it.
[[nodiscard]] float mean_transmittance(const Material& material,
                                       std::span<const TextureStatistics> textures);

}  // namespace weft

#endif
