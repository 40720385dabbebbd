// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_MATERIAL_H
#define WEFT_SCENE_MITSUBA_MITSUBA_MATERIAL_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/mitsuba/mitsuba_object.h"
#include "scene/scene.h"

namespace weft::mitsuba {

/// The parameters of a bsdf that Weft renders.
struct MitsubaSurface {
    std::string name;
    glm::vec3 albedo{0.5F};
    int texture = -1;        ///< index into Scene::textures, or -1
    glm::dmat4 to_uv{1.0};   ///< to be applied to the texture coordinates of the mesh
    bool two_sided = false;  ///< Mitsuba's surfaces are black from behind unless they say so
    bool invisible = false;  ///< `null`: a boundary between media
};

/// Turns bsdfs, textures and area emitters into Scene::materials and Scene::textures.
class MaterialReader {
  public:
    MaterialReader(Context& context, Scene& scene) : context_(context), scene_(scene) {}

    /// The surface of a bsdf; null stands for Mitsuba's default. Throws Error (exit code 2).
    [[nodiscard]] const MitsubaSurface& surface(const Element* bsdf);

    /// The material of a pair of bsdf and area emitter, either may be null. The same pair gives
    /// the same index into Scene::materials.
    [[nodiscard]] std::uint32_t material(const Element* bsdf, const Element* emitter);

  private:
    [[nodiscard]] MitsubaSurface read_bsdf(const Element& element);
    void read_twosided(Object& object, MitsubaSurface& surface);
    void read_unsupported(Object& object, MitsubaSurface& surface);
    void read_reflectance(const Element& element, MitsubaSurface& surface);
    void read_bitmap(Object& object, MitsubaSurface& surface);
    [[nodiscard]] glm::vec3 read_radiance(const Element& emitter);

    Context& context_;
    Scene& scene_;
    std::vector<const Element*> open_;
    std::map<const Element*, MitsubaSurface> surfaces_;
    std::map<std::pair<const Element*, const Element*>, std::uint32_t> materials_;
    std::map<std::string, int> textures_;
    std::size_t texture_bytes_ = 0;
};

}  // namespace weft::mitsuba

#endif
