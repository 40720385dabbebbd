// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_MATERIALS_H
#define WEFT_SCENE_GLTF_GLTF_MATERIALS_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <vector>

#include "scene/gltf/gltf_density.h"
#include "scene/gltf/gltf_texture_maps.h"
#include "scene/gltf/gltf_textures.h"

namespace weft {

/// What a primitive needs of its material.
struct GltfSurface {
    std::uint32_t material = 0;  ///< index into Scene::materials
    int medium = -1;  ///< index into Scene::media: an invisible boundary of it; -1: a surface
    std::optional<GltfUvs> base_colour_uvs{};  ///< empty without texture
    std::optional<GltfUvs> emission_uvs{};     ///< empty without texture
    std::vector<std::uint64_t> uv_sets{};      ///< by index into Mesh::uv_sets, the n of TEXCOORD_n
    /// The set, of `uv_sets`, by which tangents are made; none where nothing asks for them.
    std::optional<std::uint32_t> tangent_set{};
    bool has_alpha = false;  ///< alpha of the vertices counts
    bool is_solid = false;   ///< encloses a volume of glass
    bool is_wall = false;    ///< lets light pass without a volume, though it has an index
};

/// Reads the materials that primitives refer to, each once: a diffuse surface, and by `detail` what
/// the file says beyond that.
class GltfMaterials {
  public:
    GltfMaterials(const GltfDocument& document, GltfTextures& textures, WarningCollector& report,
                  GltfDensities& densities, MaterialDetail detail, std::vector<Material>& materials,
                  std::vector<Medium>& media);

    /// The material whose index `reference` holds, or glTF's default material. Throws Error (exit
    /// code 2).
    [[nodiscard]] const GltfSurface& surface(const std::optional<JsonValue>& reference);

    /// The index of a material that is as this one, which is solid glass, but thin: for meshes that
    /// enclose no volume.
    [[nodiscard]] std::uint32_t thin(std::uint32_t material);

  private:
    void describe(const JsonValue& value, Material& material, GltfSurface& surface);
    [[nodiscard]] GltfSurface convert(const JsonValue& value, std::size_t index);
    DiffuseSurface base_colour(const JsonValue& value, GltfSurface& surface);
    Emission emission(const JsonValue& value, GltfSurface& surface);
    [[nodiscard]] glm::vec3 colour(const JsonValue& place, const glm::dvec3& value,
                                   const char* what);
    void report_unsimulated(const JsonValue& value);

    JsonValue root_;
    GltfTextures& textures_;
    WarningCollector& report_;
    GltfDensities& densities_;
    MaterialDetail detail_;
    std::vector<Material>& materials_;
    std::vector<Medium>& media_;
    std::map<std::size_t, GltfSurface> surfaces_;
    std::map<std::uint32_t, std::uint32_t> thin_;  ///< by solid material
};

}  // namespace weft

#endif
