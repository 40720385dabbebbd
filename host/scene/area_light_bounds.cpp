// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/area_light_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace weft {
namespace {

std::array<glm::dvec3, 3> corners_of(const FlatScene& flat,
                                     const shared::EmissiveTriangle& emissive) {
    const shared::Triangle& triangle = flat.triangles[emissive.triangle];
    const auto corner = [&](std::uint32_t vertex) {
        const shared::float4& p = flat.positions[vertex];
        return glm::dvec3(p.x, p.y, p.z);
    };
    return {corner(triangle.v0), corner(triangle.v1), corner(triangle.v2)};
}

/// Whether the triangles are connected: in some order, each but the first shares a corner with one
/// before it.
bool hangs_together(const FlatScene& flat, std::span<const shared::EmissiveTriangle> area_light) {
    std::vector<std::array<glm::dvec3, 3>> apart;
    for (const auto& triangle : area_light.subspan(1)) apart.push_back(corners_of(flat, triangle));
    std::vector<glm::dvec3> reached;
    for (const glm::dvec3& corner : corners_of(flat, area_light.front())) reached.push_back(corner);
    const auto touches = [&](const std::array<glm::dvec3, 3>& corners) {
        return std::find_first_of(corners.begin(), corners.end(), reached.begin(), reached.end()) !=
               corners.end();
    };
    while (!apart.empty()) {
        const auto next = std::find_if(apart.begin(), apart.end(), touches);
        if (next == apart.end()) return false;
        reached.insert(reached.end(), next->begin(), next->end());
        apart.erase(next);
    }
    return true;
}

}  // namespace

AreaLightBounds area_light_bounds(const FlatScene& flat,
                                  std::span<const shared::EmissiveTriangle> area_light) {
    glm::dvec3 sum(0.0);
    for (const auto& triangle : area_light)
        for (const glm::dvec3& corner : corners_of(flat, triangle)) sum += corner;
    // Rounded to floats as kernels have it, so that the radius holds for their centre.
    const glm::vec3 centre(sum / (3.0 * static_cast<double>(area_light.size())));
    const auto [a, b, c] = corners_of(flat, area_light.front());
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    double radius = 0.0;
    double height = 0.0;
    for (const auto& triangle : area_light)
        for (const glm::dvec3& corner : corners_of(flat, triangle)) {
            const glm::dvec3 to = corner - glm::dvec3(centre);
            radius = std::max(radius, glm::length(to));
            height = std::max(height, std::abs(glm::dot(to, normal)));
        }
    AreaLightBounds bounds;
    bounds.ball = {centre.x, centre.y, centre.z,
                   std::nextafter(static_cast<float>(radius), HUGE_VALF)};
    // Corners of rotated panels are off their plane by rounding, by up to a hundred float steps.
    constexpr double flat_share = 1e-5;
    if (area_light.size() <= max_panel_triangles && height <= flat_share * radius &&
        hangs_together(flat, area_light)) {
        const glm::vec3 n(normal);
        bounds.normal = {n.x, n.y, n.z, 0.0F};
    }
    return bounds;
}

}  // namespace weft
