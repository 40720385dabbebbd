// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_DIFFUSE_SURFACE_H
#define WEFT_SCENE_SURFACE_DIFFUSE_SURFACE_H

#include <glm/glm.hpp>

namespace weft {

/// A Lambertian surface: it reflects the same radiance in all directions.
struct DiffuseSurface {
    glm::vec3 albedo{0.8F};   ///< factor in [0,1], multiplied with texture and vertex colour
    int albedo_texture = -1;  ///< index into Scene::textures, or -1
};

/// The diffuse part of a surface.
[[nodiscard]] inline DiffuseSurface& diffuse_part(DiffuseSurface& surface) {
    return surface;
}

/// MaterialRecord::parameters, as kernels/bsdf reads them.
[[nodiscard]] inline glm::vec4 lobe_parameters(const DiffuseSurface&) {
    return glm::vec4(0.0F);
}

/// Which parameters of the lobe are out of their range, for errors ("has a roughness outside [0,
/// 1]"), or null. The diffuse part is checked elsewhere.
[[nodiscard]] inline const char* lobe_problem(const DiffuseSurface&) {
    return nullptr;
}

}  // namespace weft

#endif
