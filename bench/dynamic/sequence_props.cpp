// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/sequence_props.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace weft::bench {
namespace {

void add_block(Mesh& mesh, const glm::vec3& low, const glm::vec3& high) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (unsigned corner = 0; corner < 8; ++corner)
        mesh.positions.emplace_back((corner & 1U) != 0 ? high.x : low.x,
                                    (corner & 2U) != 0 ? high.y : low.y,
                                    (corner & 4U) != 0 ? high.z : low.z);
    constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& f : faces) {
        mesh.triangles.push_back({first + f[0], first + f[1], first + f[2]});
        mesh.triangles.push_back({first + f[0], first + f[2], first + f[3]});
    }
}

/// At the corners of a rectangle about the y axis, up to `height`.
void add_legs(Mesh& mesh, float half_width, float half_depth, float height, float thickness) {
    const float half = 0.5F * thickness;
    for (const float x : {-half_width + half, half_width - half})
        for (const float z : {-half_depth + half, half_depth - half})
            add_block(mesh, {x - half, 0.0F, z - half}, {x + half, height, z + half});
}

// The figure: rings of vertices about a spine, a vertex below and one above.
constexpr std::uint32_t rings = 32;
constexpr std::uint32_t around = 32;
constexpr std::uint32_t bottom = rings * around;
constexpr std::uint32_t top = bottom + 1;

/// Hips, waist, chest, neck and head.
double radius_at(double height) {
    return 0.11 + 0.035 * std::sin(2.0 * std::numbers::pi * (2.2 * height + 0.1)) - 0.03 * height;
}

/// Where the spine is at a share of the height.
glm::dvec3 spine_at(double height, double moment) {
    const double share = height * height;
    return {0.22 * share * std::sin(moment), height - 0.06 * share * std::abs(std::sin(moment)),
            0.12 * share * std::sin(2.0 * moment + 0.5)};
}

/// Means over the triangles about each vertex, by area.
void smooth_normals(Mesh& mesh) {
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0F));
    for (const auto& t : mesh.triangles) {
        const glm::vec3 a = mesh.positions[t[0]];
        const glm::vec3 normal = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
        for (const std::uint32_t vertex : t) mesh.normals[vertex] += normal;
    }
    for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
}

}  // namespace

Mesh prop_box() {
    Mesh mesh;
    mesh.name = "box";
    add_block(mesh, glm::vec3(-0.5F), glm::vec3(0.5F));
    return mesh;
}

Mesh prop_door() {
    Mesh mesh;
    mesh.name = "door";
    add_block(mesh, {0.0F, 0.0F, -0.02F}, {0.45F, 1.0F, 0.02F});
    return mesh;
}

Mesh prop_table() {
    Mesh mesh;
    mesh.name = "table";
    add_legs(mesh, 0.65F, 0.4F, 0.92F, 0.08F);
    add_block(mesh, {-0.7F, 0.93F, -0.45F}, {0.7F, 1.0F, 0.45F});
    return mesh;
}

Mesh prop_chair() {
    Mesh mesh;
    mesh.name = "chair";
    add_legs(mesh, 0.25F, 0.25F, 0.45F, 0.06F);
    add_block(mesh, {-0.27F, 0.46F, -0.27F}, {0.27F, 0.52F, 0.27F});
    add_block(mesh, {-0.27F, 0.53F, -0.27F}, {0.27F, 1.0F, -0.21F});
    return mesh;
}

Mesh prop_shelf() {
    Mesh mesh;
    mesh.name = "shelf";
    add_block(mesh, {-0.4F, 0.0F, -0.2F}, {-0.36F, 1.0F, 0.2F});
    add_block(mesh, {0.36F, 0.0F, -0.2F}, {0.4F, 1.0F, 0.2F});
    for (const float y : {0.02F, 0.48F, 0.94F})
        add_block(mesh, {-0.355F, y, -0.16F}, {0.355F, y + 0.04F, 0.2F});
    add_block(mesh, {-0.355F, 0.0F, -0.2F}, {0.355F, 1.0F, -0.165F});
    return mesh;
}

Mesh prop_figure() {
    Mesh mesh;
    mesh.name = "figure";
    mesh.positions.resize(top + 1);
    for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t next = (i + 1) % around;
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            const std::uint32_t below = ring * around;
            const std::uint32_t above = below + around;
            mesh.triangles.push_back({below + i, above + i, above + next});
            mesh.triangles.push_back({below + i, above + next, below + next});
        }
        mesh.triangles.push_back({bottom, i, next});
        const std::uint32_t last = (rings - 1) * around;
        mesh.triangles.push_back({top, last + next, last + i});
    }
    pose_figure(mesh, 0.0);
    return mesh;
}

void pose_figure(Mesh& figure, double moment) {
    constexpr double most_twist = 1.2;  // radians, at the top
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        const double height = static_cast<double>(ring) / (rings - 1);
        const glm::dvec3 centre = spine_at(height, moment);
        const double twist = most_twist * height * std::sin(moment);
        for (std::uint32_t i = 0; i < around; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / around;
            // A round body would hide that it twists.
            const glm::dvec2 out(std::cos(angle), 0.6 * std::sin(angle));
            const glm::dvec3 turned(out.x * std::cos(twist) - out.y * std::sin(twist), 0.0,
                                    out.x * std::sin(twist) + out.y * std::cos(twist));
            figure.positions[ring * around + i] = glm::vec3(centre + radius_at(height) * turned);
        }
    }
    figure.positions[bottom] = glm::vec3(spine_at(0.0, moment));
    figure.positions[top] = glm::vec3(spine_at(1.0, moment)) + glm::vec3(0.0F, 0.02F, 0.0F);
    smooth_normals(figure);
}

}  // namespace weft::bench
