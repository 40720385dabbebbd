// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/finite.h"
#include "base/limits.h"
#include "scene/gltf/gltf_attribute.h"
#include "scene/gltf/gltf_influences.h"
#include "scene/gltf/gltf_morph.h"
#include "scene/gltf/gltf_triangles.h"
#include "scene/mesh_tangents.h"

namespace weft {
namespace {

constexpr WarningUnit primitive_unit{"primitive", "primitives"};

std::size_t drop_nonfinite(const GltfAccessor& positions, GltfTriangles& triangles) {
    return std::erase_if(triangles, [&](const auto& triangle) {
        return !std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
            return is_finite(read_gltf_vector(positions, corner));
        });
    });
}

/// Mean of the normals of the triangles around each vertex, weighted by area; not normalized.
std::vector<glm::dvec3> area_normals(const Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3{0.0});
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 origin(mesh.positions[a]);
        const glm::dvec3 normal = glm::cross(glm::dvec3(mesh.positions[b]) - origin,
                                             glm::dvec3(mesh.positions[c]) - origin);
        for (const std::uint32_t corner : {a, b, c}) sums[corner] += normal;
    }
    return sums;
}

/// Unit vector of any finite `v`, or zero where it has no direction.
glm::dvec3 direction_of(const glm::dvec3& v) {
    if (!is_finite(v)) return glm::dvec3{0.0};
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0.0 ? glm::normalize(v / largest) : glm::dvec3{0.0};
}

void read_normals(const GltfAccessor& accessor, const std::vector<std::uint32_t>& vertices,
                  WarningCollector& report, const std::string& place, Mesh& mesh) {
    mesh.normals.resize(vertices.size());
    std::vector<std::size_t> broken;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec3 unit = direction_of(glm::dvec3(read_gltf_vector(accessor, vertices[i])));
        mesh.normals[i] = glm::vec3(unit);
        if (unit == glm::dvec3{0.0}) broken.push_back(i);
    }
    if (broken.empty()) return;
    const std::vector<glm::dvec3> fallback = area_normals(mesh);
    for (const std::size_t i : broken) {
        const glm::dvec3 unit = direction_of(fallback[i]);
        mesh.normals[i] = unit == glm::dvec3{0.0} ? glm::vec3{0.0F, 0.0F, 1.0F} : glm::vec3(unit);
    }
    report.count(place, {"normal", "normals"},
                 "zero or not finite, the normals of the faces around are used instead",
                 broken.size());
}

/// Texture coordinates of these vertices by the mapping of a texture; none without one. Warns where
/// there is a `report`.
std::vector<glm::vec2> read_uvs(GltfData& data, const JsonValue& attributes,
                                const std::optional<GltfUvs>& mapping, std::size_t vertex_count,
                                const std::vector<std::uint32_t>& vertices,
                                WarningCollector* report) {
    if (!mapping) return {};
    std::vector<glm::vec2> uvs(vertices.size(), glm::vec2{0.0F});
    const GltfAccessor* const accessor = find_gltf_attribute(
        data, attributes, "TEXCOORD_" + std::to_string(mapping->set), vertex_count, 2, 2);
    if (accessor == nullptr) {
        if (report != nullptr)
            report->count(attributes.place(), {"primitive", "primitives"},
                          "texture coordinates are missing, the first texel is used everywhere");
        return uvs;
    }
    std::size_t broken = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::vec3 raw = read_gltf_vector(*accessor, vertices[i]);
        const glm::vec2 uv(mapping->transform * glm::dvec3(raw.x, raw.y, 1.0));
        const bool good = is_finite(uv);
        if (good) uvs[i] = uv;
        broken += good ? 0 : 1;
    }
    if (report != nullptr)
        report->count(attributes.place(), {"texture coordinate", "texture coordinates"},
                      "not finite, zero is used instead", broken);
    return uvs;
}

/// Alpha of the vertices' colours; none where those have none.
std::vector<float> read_alphas(const GltfAccessor& accessor,
                               const std::vector<std::uint32_t>& vertices) {
    std::vector<float> alphas;
    if (accessor.width() < 4) return alphas;
    alphas.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) {
        std::array<float, 4> values{};
        accessor.read(vertex, values);
        // fmax and fmin also turn NaN into a number.
        alphas.push_back(std::fmin(std::fmax(values[3], 0.0F), 1.0F));
    }
    return alphas;
}

void read_colours(const GltfAccessor& accessor, const std::vector<std::uint32_t>& vertices,
                  WarningCollector& report, const std::string& place, Mesh& mesh) {
    mesh.colours.resize(vertices.size());
    std::size_t clamped = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::vec3 raw = read_gltf_vector(accessor, vertices[i]);
        // fmax and fmin also turn NaN into a number.
        for (int c = 0; c < 3; ++c) mesh.colours[i][c] = std::fmin(std::fmax(raw[c], 0.0F), 1.0F);
        clamped += mesh.colours[i] == raw ? 0 : 1;
    }
    report.count(place, {"vertex colour", "vertex colours"}, "outside of [0, 1], clamped", clamped);
}

void read_attributes(GltfData& data, const JsonValue& attributes, const GltfSurface& surface,
                     std::size_t vertex_count, const std::vector<std::uint32_t>& vertices,
                     WarningCollector& report, Mesh& mesh) {
    const std::string& place = attributes.place();
    if (const GltfAccessor* normals =
            find_gltf_attribute(data, attributes, "NORMAL", vertex_count, 3, 3))
        read_normals(*normals, vertices, report, place, mesh);
    if (const GltfAccessor* colours =
            find_gltf_attribute(data, attributes, "COLOR_0", vertex_count, 3, 4)) {
        read_colours(*colours, vertices, report, place, mesh);
        if (surface.has_alpha) mesh.alphas = read_alphas(*colours, vertices);
    }
    const auto uvs_by = [&](const std::optional<GltfUvs>& mapping, WarningCollector* to) {
        return read_uvs(data, attributes, mapping, vertex_count, vertices, to);
    };
    mesh.uvs = uvs_by(surface.base_colour_uvs, &report);
    if (surface.emission_uvs != surface.base_colour_uvs)
        mesh.emission_uvs = uvs_by(surface.emission_uvs, &report);
    for (const std::uint64_t set : surface.uv_sets) {
        const auto is_told = [&](const std::optional<GltfUvs>& mapping) {
            return mapping && mapping->set == set;
        };
        const bool told = is_told(surface.base_colour_uvs) || is_told(surface.emission_uvs);
        mesh.uv_sets.push_back(uvs_by(GltfUvs{set}, told ? nullptr : &report));
    }
}

/// Reads tangents, or makes them, where the surface asks for them. Of vertices that need two,
/// copies are appended to the mesh and to `vertices`.
void read_tangents(GltfData& data, const JsonValue& attributes, const GltfSurface& surface,
                   std::size_t vertex_count, std::vector<std::uint32_t>& vertices, Mesh& mesh) {
    if (!surface.tangent_set) return;
    const GltfAccessor* const tangents =
        mesh.normals.empty() ? nullptr
                             : find_gltf_attribute(data, attributes, "TANGENT", vertex_count, 4, 4);
    if (tangents == nullptr) {
        for (const std::uint32_t copy : add_tangents(mesh, *surface.tangent_set))
            vertices.push_back(vertices[copy]);
        return;
    }
    mesh.tangents.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) {
        std::array<float, 4> values{};
        tangents->read(vertex, values);
        const glm::vec3 along(values[0], values[1], values[2]);
        mesh.tangents.emplace_back(std::isfinite(glm::dot(along, along)) ? along : glm::vec3(0.0F),
                                   values[3] < 0.0F ? -1.0F : 1.0F);
    }
}

/// Reads the shape that a mesh of these vertices is deformed from.
MeshShape read_shape(GltfData& data, const JsonValue& primitive, std::size_t vertex_count,
                     const std::vector<std::uint32_t>& vertices, const GltfForms& forms,
                     const Mesh& mesh, WarningCollector& report, GltfCounts& read) {
    MeshShape shape;
    shape.positions = mesh.positions;
    shape.normals = mesh.normals;
    shape.tangents = mesh.tangents;
    if (forms.morphed)
        shape.targets = read_gltf_targets(data, primitive, vertex_count, vertices,
                                          !mesh.normals.empty(), report, read.deltas);
    if (forms.skinned)
        shape.influences = read_gltf_influences(data, primitive.at("attributes"), vertex_count,
                                                vertices, report, read.influences);
    return shape;
}

}  // namespace

std::optional<GltfPrimitive> read_gltf_primitive(GltfData& data, const JsonValue& primitive,
                                                 const GltfSurface& surface, const GltfForms& forms,
                                                 WarningCollector& report, GltfCounts& read) {
    const std::uint64_t mode = primitive.integer_or("mode", 4);
    if (mode > 6)
        throw primitive.at("mode").error("is " + std::to_string(mode) + ", expected 0 to 6");
    if (mode < 4) {
        report.count(primitive.place(), primitive_unit,
                     "points and lines are not simulated, they are left out");
        return std::nullopt;
    }
    const JsonValue attributes = primitive.at("attributes");
    if (!attributes.find("POSITION")) {
        report.count(primitive.place(), primitive_unit, "POSITION is missing, left out");
        return std::nullopt;
    }
    const GltfAccessor& positions = *find_gltf_attribute(
        data, attributes, "POSITION", data.accessor(attributes.at("POSITION")).count(), 3, 3);
    const std::size_t vertex_count = positions.count();
    GltfTriangles triangles =
        read_gltf_triangles(data, primitive, mode, vertex_count, read.triangles);
    report.count(primitive.place(), {"triangle", "triangles"}, "a vertex is not finite, left out",
                 drop_nonfinite(positions, triangles));
    if (triangles.empty()) {
        report.count(primitive.place(), primitive_unit, "no triangles are given, left out");
        return std::nullopt;
    }
    GltfPrimitive made;
    Mesh& mesh = made.mesh;
    std::vector<std::uint32_t> vertices = compact_vertices(triangles, vertex_count);
    mesh.triangles = std::move(triangles);
    mesh.positions.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices)
        mesh.positions.push_back(read_gltf_vector(positions, vertex));
    read_attributes(data, attributes, surface, vertex_count, vertices, report, mesh);
    read_tangents(data, attributes, surface, vertex_count, vertices, mesh);
    if (forms.skinned || forms.morphed)
        made.shape = read_shape(data, primitive, vertex_count, vertices, forms, mesh, report, read);
    return made;
}

}  // namespace weft
