// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_MATERIAL_H
#define WEFT_SCENE_MITSUBA_MITSUBA_MATERIAL_H

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/mesh_tangents.h"
#include "scene/mitsuba/mitsuba_object.h"
#include "scene/mitsuba/mitsuba_texture.h"
#include "scene/scene.h"

namespace weft::mitsuba {

/// What a bsdf says of a surface: the diffuse one that is rendered, and what is more than that.
struct MitsubaSurface {
    std::string name;
    glm::vec3 albedo{0.5F};
    int texture = -1;        ///< index into Scene::textures, or -1
    glm::dmat3 to_uv{1.0};   ///< applied to (u, v, 1) of the mesh
    bool two_sided = false;  ///< Mitsuba's surfaces are black from behind unless they say so
    bool invisible = false;  ///< `null`: a boundary between media
    std::optional<SurfaceDescription> description{};  ///< empty where it is no more than diffuse

    /// The texture of the diffuse surface.
    [[nodiscard]] TextureMap map() const { return {texture, 0, to_uv, Channel::rgb}; }
    /// Whether the description needs texture coordinates.
    [[nodiscard]] bool has_maps() const {
        return description && !texture_maps(*description).empty();
    }
    /// Whether its lobes have a direction, along which u grows.
    [[nodiscard]] bool has_direction() const {
        return description && tangent_uv_set(*description).has_value();
    }
};

/// Turns bsdfs, textures and area emitters into Scene::materials and Scene::textures.
class MaterialReader {
  public:
    MaterialReader(Context& context, Scene& scene, MaterialDetail detail)
        : context_(context), scene_(scene), detail_(detail), textures_(context, scene) {}

    /// The surface of a bsdf; null stands for Mitsuba's default. Throws Error (exit code 2).
    [[nodiscard]] const MitsubaSurface& surface(const Element* bsdf);

    /// The material of a pair of bsdf and area emitter, either may be null. The same pair gives
    /// the same index into Scene::materials.
    [[nodiscard]] std::uint32_t material(const Element* bsdf, const Element* emitter);

  private:
    [[nodiscard]] MitsubaSurface read_bsdf(const Element& element);
    void read_twosided(Object& object, MitsubaSurface& surface);
    void read_replaced(Object& object, MitsubaSurface& surface);
    /// Reads what is more than diffuse. Returns false where that is not known.
    [[nodiscard]] bool describe(Object& object, const std::vector<const Element*>& inner,
                                MitsubaSurface& surface);
    /// The opacity of a mask around a mask.
    [[nodiscard]] Opacity combine(Object& object, const Opacity& inner, Opacity outer);
    void read_reflectance(const Element& element, MitsubaSurface& surface);
    [[nodiscard]] glm::vec3 read_radiance(const Element& emitter);

    Context& context_;
    Scene& scene_;
    MaterialDetail detail_;
    TextureReader textures_;
    std::vector<const Element*> open_;
    std::map<const Element*, MitsubaSurface> surfaces_;
    std::map<std::pair<const Element*, const Element*>, std::uint32_t> materials_;
};

}  // namespace weft::mitsuba

#endif
