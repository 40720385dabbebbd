// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_reader.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/finite.h"
#include "base/limits.h"
#include "base/warning_collector.h"
#include "scene/closed_mesh.h"
#include "scene/mesh_edit.h"
#include "scene/obj/obj_data.h"
#include "scene/obj/obj_material.h"
#include "scene/obj/obj_mesh.h"

namespace weft {
namespace {

ObjData read_data(const std::filesystem::path& path, const std::string& place,
                  WarningCollector& report) {
    const std::vector<std::byte> bytes = read_file(path, limits::max_obj_file_bytes, place);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return parse_obj(text, path.string(), report);
}

/// The faces of one material of the scene, wherever in the file they are.
struct Part {
    ObjSurface surface;
    std::vector<std::uint32_t> faces;
};

std::map<std::uint32_t, Part> parts_of(const ObjData& data, ObjMaterials& materials) {
    std::map<std::uint32_t, Part> parts;
    const auto add = [&](const ObjSurface& surface, std::size_t begin, std::size_t end) {
        if (begin == end) return;
        Part& part = parts.try_emplace(surface.material, Part{surface, {}}).first->second;
        for (std::size_t face = begin; face < end; ++face)
            part.faces.push_back(static_cast<std::uint32_t>(face));
    };
    const std::size_t first_use = data.uses.empty() ? data.faces.size() : data.uses[0].first_face;
    if (first_use > 0) add(materials.default_surface(), 0, first_use);
    for (std::size_t i = 0; i < data.uses.size(); ++i) {
        const std::size_t begin = data.uses[i].first_face;
        const std::size_t end =
            i + 1 < data.uses.size() ? data.uses[i + 1].first_face : data.faces.size();
        if (begin == end) continue;
        add(materials.surface(data.material_names[data.uses[i].name],
                              data.place(data.faces[begin])),
            begin, end);
    }
    return parts;
}

bool is_textured(const ObjSurface& surface) {
    return surface.diffuse_uvs || surface.emission_uvs || surface.has_maps;
}

/// Coordinates for a texture from those of the file. Image coordinates run downwards in Weft, and
/// upwards in the file.
std::vector<glm::vec2> fitted(std::vector<glm::vec2> uvs, const ObjUvs& mapping) {
    for (glm::vec2& uv : uvs) {
        const glm::dvec2 placed = glm::dvec2(uv) * mapping.scale + mapping.offset;
        const glm::vec2 flipped(placed.x, 1.0 - placed.y);
        uv = is_finite(flipped) ? flipped : glm::vec2(0.0F);
    }
    return uvs;
}

void fit_uvs(const ObjSurface& surface, Mesh& mesh) {
    if (surface.has_maps) {
        mesh.uv_sets = {fitted(mesh.uvs, {})};
        mesh.uv_sets[0].resize(mesh.positions.size(), glm::vec2(0.0F));
    }
    if (surface.emission_uvs && surface.emission_uvs != surface.diffuse_uvs)
        mesh.emission_uvs = fitted(mesh.uvs, *surface.emission_uvs);
    mesh.uvs = surface.diffuse_uvs ? fitted(std::move(mesh.uvs), *surface.diffuse_uvs)
                                   : std::vector<glm::vec2>();
}

/// Clear glass encloses a volume where its mesh does, and is a thin wall elsewhere.
void settle_glass(const Mesh& mesh, Material& material) {
    if (!material.description) return;
    if (auto* const glass = std::get_if<DielectricSurface>(&material.description->model))
        glass->thin = !is_closed(mesh);
}

}  // namespace

Scene read_obj(const std::filesystem::path& path, Diagnostics& diagnostics, MaterialDetail detail) {
    WarningCollector report(diagnostics);
    const ObjData data = read_data(path, "", report);
    Scene scene;
    scene.source = path.string();
    ObjMaterials materials(path, report, detail, scene);
    for (const ObjLibrary& library : data.libraries) materials.read_library(library);
    ObjMeshMaker maker(data, report);
    for (const auto& [index, part] : parts_of(data, materials)) {
        Mesh mesh = maker.make(part.faces, {is_textured(part.surface), true, true});
        if (mesh.triangles.empty()) continue;
        mesh.name = scene.materials[index].name;
        // Vertex colours are the whole albedo where no material adds its own.
        if (!mesh.colours.empty() && materials.is_default(index))
            set_diffuse_albedo(scene.materials[index], glm::vec3(1.0F));
        fit_uvs(part.surface, mesh);
        settle_glass(mesh, scene.materials[index]);
        orient_by_normals(mesh);
        Instance instance;
        instance.name = mesh.name;
        instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
        instance.material = index;
        scene.meshes.push_back(std::move(mesh));
        scene.instances.push_back(std::move(instance));
    }
    if (scene.meshes.empty())
        throw input_error(scene.source, "holds no faces that can be rendered, expected a mesh");
    return scene;
}

Mesh read_obj_mesh(const std::filesystem::path& path, const std::string& place, bool flip_v,
                   Diagnostics& diagnostics) {
    WarningCollector report(diagnostics);
    const ObjData data = read_data(path, place, report);
    if (data.faces.empty()) report.once(path.string(), "holds no faces");
    std::vector<std::uint32_t> faces(data.faces.size());
    std::iota(faces.begin(), faces.end(), 0U);
    Mesh mesh = ObjMeshMaker(data, report).make(faces, {true, true, false});
    mesh.name = path.stem().string();
    if (flip_v)
        for (glm::vec2& uv : mesh.uvs) uv.y = 1.0F - uv.y;
    return mesh;
}

}  // namespace weft
