// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MATERIAL_H
#define WEFT_SCENE_MATERIAL_H

#include <glm/glm.hpp>
#include <string>
#include <variant>

namespace weft {

/// A Lambertian surface: it reflects the same radiance in all directions.
struct DiffuseSurface {
    glm::vec3 albedo{0.8F};   ///< factor in [0,1], multiplied with texture and vertex colour
    int albedo_texture = -1;  ///< index into Scene::textures, or -1
};

/// How a surface scatters light: the parameters of one kind of lobe (docs/adding-a-lobe.md).
using SurfaceParameters = std::variant<DiffuseSurface>;

/// What a surface emits.
struct Emission {
    glm::vec3 radiance{0.0F};  ///< W/(m^2 sr)
    bool both_sides = false;   ///< else only to the side of the geometric normal
};

/// A surface that scatters light and may emit. Colours are linear Rec.709.
struct Material {
    std::string name;
    SurfaceParameters surface;
    Emission emission;
    bool two_sided = true;  ///< scatters on both sides; else its back is black
};

/// The factor in [0,1] with which a surface reflects diffusely, without texture and vertex colour.
[[nodiscard]] glm::vec3 diffuse_albedo(const Material& material);

/// Index into Scene::textures of what that is multiplied with, or -1.
[[nodiscard]] int albedo_texture(const Material& material);

/// Replace the one and the other.
void set_diffuse_albedo(Material& material, const glm::vec3& albedo);
void set_albedo_texture(Material& material, int texture);

}  // namespace weft

#endif
