// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/finite.h"
#include "base/limits.h"

namespace weft {

bool ObjMeshMaker::is_usable_normal(std::int32_t normal) const {
    return normal >= 0 && data_.normals[static_cast<std::size_t>(normal)] != glm::vec3(0.0F);
}

bool ObjMeshMaker::has_normals(std::span<const std::uint32_t> faces) const {
    return std::any_of(faces.begin(), faces.end(), [&](std::uint32_t index) {
        const ObjFace& face = data_.faces[index];
        for (std::uint32_t i = face.first; i < face.first + face.count; ++i)
            if (is_usable_normal(data_.corners[i].normal)) return true;
        return false;
    });
}

void ObjMeshMaker::add_face(const ObjFace& face, const ObjMeshOptions& options, bool any_normals) {
    polygon_.clear();
    for (std::uint32_t i = face.first; i < face.first + face.count; ++i) {
        const auto position = static_cast<std::size_t>(data_.corners[i].position);
        polygon_.emplace_back(data_.positions[position]);
    }
    if (!all_finite(polygon_)) {
        report_.count(data_.place(face), {"face", "faces"}, "a vertex is not finite, left out");
        return;
    }
    const auto first = static_cast<std::uint32_t>(keys_.size());
    const auto own_normal = static_cast<std::int32_t>(data_.normals.size() + face_normals_.size());
    bool uses_own_normal = false;
    for (std::uint32_t i = 0; i < face.count; ++i) {
        const ObjCorner& corner = data_.corners[face.first + i];
        Key key{corner.position, options.uvs ? corner.uv : -1, -1, first + i};
        if (any_normals) {
            const bool usable = is_usable_normal(corner.normal);
            uses_own_normal = uses_own_normal || !usable;
            key.normal = usable ? corner.normal : own_normal;
        }
        keys_.push_back(key);
    }
    if (uses_own_normal) {
        const glm::dvec3 normal = polygon_normal(polygon_);
        const double length = glm::length(normal);
        const bool usable = length > 0.0 && std::isfinite(length);
        face_normals_.push_back(usable ? glm::vec3(normal / length) : glm::vec3(0.0F, 0.0F, 1.0F));
    }
    const std::size_t given_up = cutter_.given_up();
    for (const auto& [a, b, c] : cutter_.cut(polygon_))
        triangles_.push_back({first + a, first + b, first + c});
    report_.count(data_.place(face), {"concave polygon", "concave polygons"},
                  "too many corners to cut along, cut into a fan instead",
                  cutter_.given_up() - given_up);
}

void ObjMeshMaker::add_vertex(const Key& key, const ObjMeshOptions& options, bool any_normals,
                              Mesh& mesh) {
    const auto position = static_cast<std::size_t>(key.position);
    mesh.positions.push_back(data_.positions[position]);
    if (options.colours && !data_.colours.empty()) mesh.colours.push_back(data_.colours[position]);
    if (any_normals) {
        const auto normal = static_cast<std::size_t>(key.normal);
        mesh.normals.push_back(normal < data_.normals.size()
                                   ? data_.normals[normal]
                                   : face_normals_[normal - data_.normals.size()]);
    }
    if (options.uvs)
        mesh.uvs.push_back(key.uv >= 0 ? data_.uvs[static_cast<std::size_t>(key.uv)]
                                       : glm::vec2(0.0F));
}

Mesh ObjMeshMaker::make(std::span<const std::uint32_t> faces, const ObjMeshOptions& wanted) {
    keys_.clear();
    triangles_.clear();
    face_normals_.clear();
    const bool any_normals = wanted.normals && has_normals(faces);
    for (const std::uint32_t face : faces) add_face(data_.faces[face], wanted, any_normals);
    ObjMeshOptions options = wanted;
    // A mesh without any texture coordinates differs from one that has them all at zero.
    options.uvs = wanted.uvs && std::any_of(keys_.begin(), keys_.end(),
                                            [](const Key& key) { return key.uv >= 0; });
    std::sort(keys_.begin(), keys_.end(), [](const Key& a, const Key& b) {
        return std::tie(a.position, a.uv, a.normal, a.corner) <
               std::tie(b.position, b.uv, b.normal, b.corner);
    });
    Mesh mesh;
    std::vector<std::uint32_t> vertex_of(keys_.size());
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const auto identity = [](const Key& key) {
            return std::tie(key.position, key.uv, key.normal);
        };
        if (i == 0 || identity(keys_[i]) != identity(keys_[i - 1])) {
            if (mesh.positions.size() >= limits::max_vertices)
                throw input_error(data_.file, fmt::format("more than {} different corners, "
                                                          "expected fewer",
                                                          limits::max_vertices));
            add_vertex(keys_[i], options, any_normals, mesh);
        }
        vertex_of[keys_[i].corner] = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }
    mesh.triangles.reserve(triangles_.size());
    for (const auto& [a, b, c] : triangles_)
        mesh.triangles.push_back({vertex_of[a], vertex_of[b], vertex_of[c]});
    return mesh;
}

}  // namespace weft
