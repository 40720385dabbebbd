// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh_edit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/limits.h"

namespace weft {

namespace {

template <typename Value>
std::vector<Value> unweld(const std::vector<Value>& values, const Mesh& mesh) {
    std::vector<Value> result;
    if (values.empty()) return result;
    result.reserve(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) result.push_back(values[vertex]);
    }
    return result;
}

/// Stable for small angles too, where the arc cosine of a dot product is not.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

void mirror_mesh(Mesh& mesh) {
    for (glm::vec3& position : mesh.positions) position.x = -position.x;
    for (glm::vec3& normal : mesh.normals) normal.x = -normal.x;
}

void reverse_triangles(Mesh& mesh) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

void orient_by_normals(Mesh& mesh) {
    if (mesh.normals.empty()) return;
    for (auto& triangle : mesh.triangles) {
        const auto& [a, b, c] = triangle;
        const glm::dvec3 origin(mesh.positions[a]);
        const glm::dvec3 geometric = glm::cross(glm::dvec3(mesh.positions[b]) - origin,
                                                glm::dvec3(mesh.positions[c]) - origin);
        const glm::dvec3 shading(mesh.normals[a] + mesh.normals[b] + mesh.normals[c]);
        if (glm::dot(geometric, shading) < 0.0) std::swap(triangle[1], triangle[2]);
    }
}

void add_smooth_normals(Mesh& mesh, const glm::dmat3& to_world) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (const auto& triangle : mesh.triangles) {
        std::array<glm::dvec3, 3> corner{};
        for (std::size_t i = 0; i < 3; ++i)
            corner[i] = to_world * glm::dvec3(mesh.positions[triangle[i]]);
        const glm::dvec3 area = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        const double length = glm::length(area);
        if (!(length > 0.0)) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 to_next = corner[(i + 1) % 3] - corner[i];
            const glm::dvec3 to_previous = corner[(i + 2) % 3] - corner[i];
            sums[triangle[i]] += area / length * angle_between(to_next, to_previous);
        }
    }
    // Normals go to the world by the inverse transpose, so they come back by the transpose.
    const glm::dmat3 to_object = glm::transpose(to_world);
    mesh.normals.assign(mesh.positions.size(), glm::vec3(1.0F, 0.0F, 0.0F));
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const glm::dvec3 normal = to_object * sums[i];
        const double length = glm::length(normal);
        if (length > 0.0 && std::isfinite(length)) mesh.normals[i] = glm::vec3(normal / length);
    }
}

bool add_barycentric_uvs(Mesh& mesh) {
    const std::size_t count = 3 * mesh.triangles.size();
    if (count > limits::max_vertices) return false;
    mesh.positions = unweld(mesh.positions, mesh);
    mesh.normals = unweld(mesh.normals, mesh);
    mesh.colours = unweld(mesh.colours, mesh);
    mesh.alphas = unweld(mesh.alphas, mesh);
    mesh.uvs.clear();
    mesh.uvs.reserve(count);
    std::uint32_t vertex = 0;
    for (auto& triangle : mesh.triangles) {
        mesh.uvs.insert(mesh.uvs.end(), {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)});
        triangle = {vertex, vertex + 1, vertex + 2};
        vertex += 3;
    }
    return true;
}

void transform_uvs(Mesh& mesh, const glm::dmat3& to_uv) {
    for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(to_uv * glm::dvec3(glm::dvec2(uv), 1.0));
}

bool is_within_limits(const Mesh& mesh, const glm::dmat4& to_world) {
    const auto inside = [&](const glm::vec3& position) {
        const glm::dvec3 point(to_world * glm::dvec4(glm::dvec3(position), 1.0));
        const glm::dvec3 size = glm::abs(point);
        // Also false for NaN.
        return size.x <= limits::max_coordinate && size.y <= limits::max_coordinate &&
               size.z <= limits::max_coordinate;
    };
    return std::all_of(mesh.positions.begin(), mesh.positions.end(), inside);
}

}  // namespace weft
