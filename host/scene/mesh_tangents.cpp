// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh_tangents.h"

#include <variant>

#include "scene/tangents.h"

namespace weft {
namespace {

/// Appends copies of entries `copies` to an attribute that the mesh has.
template <typename T>
void append_copies(const std::vector<std::uint32_t>& copies, std::vector<T>& attribute) {
    if (attribute.empty()) return;
    attribute.reserve(attribute.size() + copies.size());
    for (const std::uint32_t vertex : copies) attribute.push_back(T(attribute[vertex]));
}

std::uint32_t set_of(const TextureMap& map) {
    return map.present() ? map.uv_set : 0;
}

}  // namespace

std::optional<std::uint32_t> tangent_uv_set(const SurfaceDescription& surface) {
    if (surface.normal_map.present()) return surface.normal_map.map.uv_set;
    if (const auto* const metallic = std::get_if<MetallicSurface>(&surface.model)) {
        if (metallic->clearcoat.normal_map.present())
            return metallic->clearcoat.normal_map.map.uv_set;
        if (metallic->anisotropy.strength > 0.0F) return set_of(metallic->anisotropy.map);
    }
    const auto by_both = [](const auto& model) -> std::optional<std::uint32_t> {
        const TextureMap& u = model.roughness_u.value.map;
        if (model.roughness_u.value.factor == model.roughness_v.value.factor &&
            u == model.roughness_v.value.map)
            return std::nullopt;
        return set_of(u);
    };
    if (const auto* const conductor = std::get_if<ConductorSurface>(&surface.model))
        return by_both(*conductor);
    if (const auto* const dielectric = std::get_if<DielectricSurface>(&surface.model))
        return by_both(*dielectric);
    return std::nullopt;
}

std::vector<std::uint32_t> add_tangents(Mesh& mesh, std::uint32_t uv_set) {
    static const std::vector<glm::vec2> none;
    MeshTangents made =
        make_tangents(mesh, uv_set < mesh.uv_sets.size() ? mesh.uv_sets[uv_set] : none);
    mesh.tangents = std::move(made.tangents);
    mesh.triangles = std::move(made.triangles);
    append_copies(made.copies, mesh.positions);
    append_copies(made.copies, mesh.normals);
    append_copies(made.copies, mesh.uvs);
    append_copies(made.copies, mesh.emission_uvs);
    append_copies(made.copies, mesh.colours);
    append_copies(made.copies, mesh.alphas);
    for (std::vector<glm::vec2>& uvs : mesh.uv_sets) append_copies(made.copies, uvs);
    return std::move(made.copies);
}

void add_missing_tangents(Scene& scene) {
    for (const Instance& instance : scene.instances) {
        const Material& material = scene.materials[instance.material];
        Mesh& mesh = scene.meshes[instance.mesh];
        if (!material.description || !mesh.tangents.empty() || instance.deformation >= 0) continue;
        if (const auto set = tangent_uv_set(*material.description)) add_tangents(mesh, *set);
    }
}

}  // namespace weft
