// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MATERIAL_H
#define WEFT_SCENE_MATERIAL_H

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <variant>

#include "kernels/bsdf/lobes.h"
#include "scene/surface/diffuse_surface.h"
#include "scene/surface/surface_description.h"

namespace weft {

/// The variant of all types but the first: lists by macro begin with a comma.
template <class First, class... Others>
struct VariantOfOthers {
    using type = std::variant<Others...>;
};

/// How a surface scatters light: the parameters of one lobe, in the order of
/// kernels/bsdf/lobes.h (docs/adding-a-lobe.md).
#define WEFT_SURFACE_ENTRY(NUMBER, name, surface) , surface
using SurfaceParameters = VariantOfOthers<void ALL_LOBES(WEFT_SURFACE_ENTRY)>::type;
#undef WEFT_SURFACE_ENTRY

/// How much of what a file says of materials is kept: all of it, or no more than the Lambertian
/// surface that stands for it.
enum class MaterialDetail : std::uint8_t { full, diffuse };

/// The light that a surface emits.
struct Emission {
    glm::vec3 radiance{0.0F};  ///< W/(m^2 sr)
    bool both_sides = false;   ///< false: only to the side of the geometric normal
    int texture = -1;          ///< index into Scene::textures that multiplies radiance, or -1
};

/// A surface that scatters light and may emit. Colours are linear Rec.709.
struct Material {
    std::string name;
    SurfaceParameters surface;
    Emission emission;
    bool two_sided = true;  ///< scatters on both sides; false: its back is black
    /// What the file says of the surface, where that is more than `surface`, which is rendered in
    /// its place.
    std::optional<SurfaceDescription> description{};
};

/// The number of a material's lobe: LOBE_* of kernels/bsdf/lobe.h.
[[nodiscard]] inline std::uint32_t lobe_of(const Material& material) {
    return static_cast<std::uint32_t>(material.surface.index());
}

/// Whether a material reflects by Lambert's law alone.
[[nodiscard]] inline bool is_lambertian(const Material& material) {
    return std::holds_alternative<DiffuseSurface>(material.surface);
}

/// The factor in [0,1] with which a surface reflects diffusely, without texture and vertex colour.
[[nodiscard]] glm::vec3 diffuse_albedo(const Material& material);

/// Index into Scene::textures of the texture that diffuse_albedo is multiplied with, or -1.
[[nodiscard]] int albedo_texture(const Material& material);

/// Replaces diffuse_albedo, [0,1], and the colour of the description that it stands for.
void set_diffuse_albedo(Material& material, const glm::vec3& albedo);
/// Replaces albedo_texture, likewise; -1 for none.
void set_albedo_texture(Material& material, int texture);

/// The perceived roughness of a material's surface, 0 to 1, which its texture is multiplied with,
/// along u where it has two; empty where it has none, as a diffuse one.
[[nodiscard]] std::optional<double> perceived_roughness(const Material& material);
/// Brings it by a share of the way to `goal`, along both directions, where there is one.
void fade_roughness(Material& material, double goal, double share = 1.0);

}  // namespace weft

#endif
