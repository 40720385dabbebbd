// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/automatic_camera.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

const glm::dvec3 usual_side = glm::normalize(glm::dvec3(0.5, 0.35, 1.0));  // towards the camera
// Ratios of a scene's least to its middle extent, and of its middle to its largest one, up to which
// it is entirely flat, or long, and from which on it is not at all.
constexpr double surely_flat = 0.15;
constexpr double not_flat = 0.35;
// Tangent of the angle from which a scene that is not quite flat is seen, so that what rises from
// it is seen from the side as well, and by how much of its least extent to its middle one.
constexpr double most_tilt = 0.7;
constexpr double full_tilt_at = 0.1;
// Share by which the image is wider than what it shows.
constexpr double margin = 1.05;

/// How the area of a scene's surfaces is spread.
struct SurfaceSpread {
    std::array<glm::dvec3, 3> axis;  ///< unit, from the one of least to that of largest extent
    glm::dvec3 deviation{0.0};       ///< standard deviations of surface points along them
    glm::dvec3 mean_normal{0.0};     ///< of length 1 where all surfaces face one way
};

/// Eigenvectors and eigenvalues of a symmetric matrix (Jacobi's method), smallest first.
void find_axes(glm::dmat3 m, std::array<glm::dvec3, 3>& axis, glm::dvec3& value) {
    glm::dmat3 vectors(1.0);
    constexpr int sweeps = 32;
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (m[p][q] == 0.0) continue;
                const double theta = 0.5 * std::atan2(2.0 * m[p][q], m[q][q] - m[p][p]);
                glm::dmat3 turn(1.0);
                turn[p][p] = turn[q][q] = std::cos(theta);
                turn[q][p] = std::sin(theta);
                turn[p][q] = -turn[q][p];
                m = glm::transpose(turn) * m * turn;
                vectors = vectors * turn;
            }
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return m[a][a] < m[b][b]; });
    for (int i = 0; i < 3; ++i) {
        const int from = order[static_cast<std::size_t>(i)];
        axis[static_cast<std::size_t>(i)] = vectors[from];
        value[i] = std::max(0.0, m[from][from]);
    }
}

SurfaceSpread spread_of(const FlatScene& scene) {
    const auto vertex = [&](std::uint32_t v) {
        const shared::float4& p = scene.positions[v];
        return glm::dvec3(p.x, p.y, p.z);
    };
    double area = 0.0;
    glm::dvec3 first(0.0);
    glm::dmat3 second(0.0);
    glm::dvec3 normal(0.0);
    for (const shared::Triangle& triangle : scene.triangles) {
        const std::array<glm::dvec3, 3> corner{vertex(triangle.v0), vertex(triangle.v1),
                                               vertex(triangle.v2)};
        const glm::dvec3 doubled = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        const double weight = 0.5 * glm::length(doubled);
        // The integral of x x^T over a triangle is its area / 12 times the sum over its corners
        // and nine times its middle.
        const glm::dvec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0;
        glm::dmat3 square = 9.0 * glm::outerProduct(middle, middle);
        for (const glm::dvec3& c : corner) square += glm::outerProduct(c, c);
        area += weight;
        first += weight * middle;
        second += weight / 12.0 * square;
        normal += 0.5 * doubled;
    }
    SurfaceSpread spread;
    spread.axis = {glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0)};
    spread.deviation = glm::dvec3(1.0);
    if (!(area > 0.0)) return spread;
    first /= area;
    glm::dvec3 variance(0.0);
    find_axes(second / area - glm::outerProduct(first, first), spread.axis, variance);
    spread.deviation = glm::sqrt(variance);
    spread.mean_normal = normal / area;
    return spread;
}

/// 1 for small ratios of extents, 0 for large ones, without a step between.
double share_by_ratio(double small, double large) {
    if (!(large > 0.0)) return 0.0;
    return std::clamp((not_flat - small / large) / (not_flat - surely_flat), 0.0, 1.0);
}

/// From where a flat scene is seen: the side that its surfaces face, or else that of the usual
/// view; and the more it rises, the more from the usual direction.
glm::dvec3 wide_side(const SurfaceSpread& spread) {
    constexpr double facing = 0.2;
    glm::dvec3 normal = spread.axis[0];
    const double faces = glm::dot(normal, spread.mean_normal);
    if (std::abs(faces) > facing ? faces < 0.0 : glm::dot(normal, usual_side) < 0.0)
        normal = -normal;
    const glm::dvec3 aside = usual_side - glm::dot(usual_side, normal) * normal;
    const double length = glm::length(aside);
    if (!(length > 0.0)) return normal;
    const double rise = spread.deviation[0] / spread.deviation[1];
    const double tilt = most_tilt * std::min(1.0, rise / full_tilt_at);
    return glm::normalize(normal + tilt / length * aside);
}

/// The direction from the scene to the camera.
glm::dvec3 side_to_see(const SurfaceSpread& spread) {
    glm::dvec3 side = usual_side;
    const double flat = share_by_ratio(spread.deviation[0], spread.deviation[1]);
    if (flat > 0.0) side = glm::normalize(glm::mix(side, wide_side(spread), flat));
    // What is long hides itself when it is seen along its length.
    constexpr double kept = 0.4;
    const double along = share_by_ratio(spread.deviation[1], spread.deviation[2]) * (1.0 - kept);
    return glm::normalize(side - along * glm::dot(side, spread.axis[2]) * spread.axis[2]);
}

/// Distance from the centre at which a camera of that tangent of half its field of view, both ways,
/// has all corners of a box about the centre in view.
double distance_for(const glm::dvec3& half, const glm::dmat3& axes, double tangent) {
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p =
            half * glm::dvec3((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                              (corner & 4) != 0 ? 1.0 : -1.0);
        const double aside =
            std::max(std::abs(glm::dot(p, axes[0])), std::abs(glm::dot(p, axes[1])));
        distance = std::max(distance, margin * aside / tangent + glm::dot(p, axes[2]));
    }
    return distance;
}

}  // namespace

Camera automatic_camera(const FlatScene& scene, const SceneBounds& bounds) {
    Camera camera;
    camera.name = "automatic";
    camera.fov_axis = FovAxis::smaller;
    const glm::dvec3 backward = side_to_see(spread_of(scene));
    // From straight above, the image's top is where -z points.
    glm::dvec3 right = glm::cross(glm::dvec3(0.0, 1.0, 0.0), backward);
    constexpr double nearly_above = 1e-3;
    right = glm::length(right) > nearly_above ? glm::normalize(right) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dmat3 axes(right, glm::normalize(glm::cross(backward, right)), backward);
    const double radius = static_cast<double>(scene.radius) / scene.units.scale;
    glm::dvec3 centre = scene.units.centre;
    double distance = radius / std::sin(0.5 * camera.fov);
    if (!bounds.empty()) {
        centre = 0.5 * (bounds.low + bounds.high);
        const double fitted =
            distance_for(0.5 * (bounds.high - bounds.low), axes, std::tan(0.5 * camera.fov));
        if (fitted > 0.0) distance = fitted;
    }
    camera.to_world =
        glm::dmat4(glm::dvec4(axes[0], 0.0), glm::dvec4(axes[1], 0.0), glm::dvec4(axes[2], 0.0),
                   glm::dvec4(centre + backward * distance, 1.0));
    return camera;
}

}  // namespace weft
