// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace weft {

namespace {

constexpr std::uint32_t sphere_slices = 72;
constexpr std::uint32_t sphere_stacks = 36;
constexpr std::uint32_t disk_segments = 128;

void add_vertex(Mesh& mesh, const glm::vec3& position, const glm::vec3& normal,
                const glm::vec2& uv) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back(uv);
}

/// A point of the unit circle. The last step equals the first one, bit for bit, so that closed
/// shapes have no crack at the seam.
glm::dvec2 on_circle(std::uint32_t step, std::uint32_t steps) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(step % steps) / steps;
    return {std::cos(angle), std::sin(angle)};
}

glm::vec3 on_sphere(std::uint32_t slice, std::uint32_t stack) {
    if (stack == 0 || stack == sphere_stacks) return {0.0F, 0.0F, stack == 0 ? 1.0F : -1.0F};
    const double theta = std::numbers::pi * static_cast<double>(stack) / sphere_stacks;
    const glm::dvec2 circle = on_circle(slice, sphere_slices) * std::sin(theta);
    return glm::vec3(glm::dvec3(circle.x, circle.y, std::cos(theta)));
}

/// The two ends of a band share its positions but not its u; at the poles, where u has no
/// meaning, each triangle has a vertex of its own with the u of its middle.
glm::vec2 sphere_uv(std::uint32_t slice, std::uint32_t stack) {
    const bool pole = stack == 0 || stack == sphere_stacks;
    const float column = static_cast<float>(slice) + (pole ? 0.5F : 0.0F);
    return {column / static_cast<float>(sphere_slices),
            static_cast<float>(stack) / static_cast<float>(sphere_stacks)};
}

}  // namespace

Mesh make_rectangle() {
    Mesh mesh;
    mesh.name = "rectangle";
    for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
        add_vertex(mesh, glm::vec3(2.0F * uv - 1.0F, 0.0F), glm::vec3(0, 0, 1), uv);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh make_cube() {
    // The directions in which u and v grow on each face; the outward normal is v x u.
    static constexpr std::array<std::array<glm::vec3, 2>, 6> axes = {{
        {{{0, 1, 0}, {0, 0, -1}}},
        {{{0, 1, 0}, {0, 0, 1}}},
        {{{-1, 0, 0}, {0, 0, -1}}},
        {{{0, 0, 1}, {1, 0, 0}}},
        {{{0, 1, 0}, {1, 0, 0}}},
        {{{0, -1, 0}, {1, 0, 0}}},
    }};
    Mesh mesh;
    mesh.name = "cube";
    for (const auto& [u_axis, v_axis] : axes) {
        const glm::vec3 normal = glm::cross(v_axis, u_axis);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec2 uv :
             {glm::vec2(0, 0), glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0)}) {
            const glm::vec2 side = 2.0F * uv - 1.0F;
            add_vertex(mesh, normal + side.x * u_axis + side.y * v_axis, normal, uv);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 2, first + 3});
    }
    return mesh;
}

Mesh make_sphere() {
    Mesh mesh;
    mesh.name = "sphere";
    for (std::uint32_t stack = 0; stack <= sphere_stacks; ++stack) {
        for (std::uint32_t slice = 0; slice <= sphere_slices; ++slice) {
            const glm::vec3 point = on_sphere(slice, stack);
            add_vertex(mesh, point, point, sphere_uv(slice, stack));
        }
    }
    const std::uint32_t row = sphere_slices + 1;
    for (std::uint32_t stack = 0; stack < sphere_stacks; ++stack) {
        for (std::uint32_t slice = 0; slice < sphere_slices; ++slice) {
            const std::uint32_t upper = stack * row + slice;
            const std::uint32_t lower = upper + row;
            if (stack > 0) mesh.triangles.push_back({upper, lower, upper + 1});
            if (stack + 1 < sphere_stacks) mesh.triangles.push_back({upper + 1, lower, lower + 1});
        }
    }
    return mesh;
}

Mesh make_disk() {
    Mesh mesh;
    mesh.name = "disk";
    const glm::vec3 normal(0, 0, 1);
    for (std::uint32_t i = 0; i <= disk_segments; ++i) {
        const auto step = static_cast<float>(i);
        const glm::dvec2 rim = on_circle(i, disk_segments);
        add_vertex(mesh, glm::vec3(glm::vec2(rim), 0.0F), normal,
                   {1.0F, step / static_cast<float>(disk_segments)});
        add_vertex(mesh, glm::vec3(0.0F), normal,
                   {0.0F, (step + 0.5F) / static_cast<float>(disk_segments)});
    }
    for (std::uint32_t i = 0; i < disk_segments; ++i)
        mesh.triangles.push_back({2 * i + 1, 2 * i, 2 * i + 2});
    return mesh;
}

}  // namespace weft
