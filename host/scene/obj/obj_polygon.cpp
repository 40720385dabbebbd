// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_polygon.h"

#include <cmath>
#include <numeric>

#include "base/limits.h"

namespace weft {

glm::dvec3 polygon_normal(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0.0);
    // Relative to a corner, so that a polygon far from the origin does not lose precision.
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return sum;
}

std::span<const PolygonCutter::Triangle> PolygonCutter::cut(std::span<const glm::dvec3> corners) {
    triangles_.clear();
    if (corners.size() > 3) {
        const glm::dvec3 normal = polygon_normal(corners);
        if (normal != glm::dvec3(0.0)) {
            project(corners, normal);
            if (!is_convex()) {
                if (clip_ears()) return triangles_;
                ++given_up_;
                triangles_.clear();
            }
        }
    }
    fan(corners.size());
    return triangles_;
}

void PolygonCutter::fan(std::size_t count) {
    for (std::uint32_t i = 1; i + 1 < count; ++i) triangles_.push_back({0, i, i + 1});
}

/// Projects the polygon along its normal's largest axis, which keeps all senses of rotation.
void PolygonCutter::project(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int dropped = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    int u = (dropped + 1) % 3;
    int v = (dropped + 2) % 3;
    if (normal[dropped] < 0.0) std::swap(u, v);
    points_.clear();
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 relative = corner - corners[0];
        points_.emplace_back(relative[u], relative[v]);
    }
}

double PolygonCutter::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const glm::dvec2 ab = points_[b] - points_[a];
    const glm::dvec2 ac = points_[c] - points_[a];
    return ab.x * ac.y - ab.y * ac.x;
}

bool PolygonCutter::is_convex() const {
    const auto count = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < count; ++i)
        if (turn(i, (i + 1) % count, (i + 2) % count) < 0.0) return false;
    // A straight corner next to the first one would make a fan of triangles without area.
    for (std::uint32_t i = 1; i + 1 < count; ++i)
        if (!(turn(0, i, i + 1) > 0.0)) return false;
    return true;
}

/// Whether the corner b sticks out with nothing of the rest in the triangle abc.
bool PolygonCutter::is_ear(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (!(turn(a, b, c) > 0.0)) return false;
    for (std::uint32_t i = next_[c]; i != a; i = next_[i]) {
        ++ear_tests_;
        const glm::dvec2& point = points_[i];
        // Holes are often bridged by two corners in one place.
        if (point == points_[a] || point == points_[b] || point == points_[c]) continue;
        if (turn(a, b, i) >= 0.0 && turn(b, c, i) >= 0.0 && turn(c, a, i) >= 0.0) return false;
    }
    return true;
}

void PolygonCutter::clip(std::uint32_t corner) {
    const std::uint32_t before = previous_[corner];
    const std::uint32_t after = next_[corner];
    triangles_.push_back({before, corner, after});
    next_[before] = after;
    previous_[after] = before;
}

/// Clips ears until a triangle remains; false where it would take too long.
bool PolygonCutter::clip_ears() {
    const auto count = static_cast<std::uint32_t>(points_.size());
    next_.resize(count);
    previous_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        next_[i] = (i + 1) % count;
        previous_[i] = (i + count - 1) % count;
    }
    std::uint32_t corner = 0;
    std::uint32_t left = count;
    std::uint32_t since_ear = 0;
    while (left > 3) {
        if (ear_tests_ > limits::max_ear_tests) return false;
        ++ear_tests_;
        const std::uint32_t after = next_[corner];
        // A polygon that crosses itself, or lies on a line, may run out of ears.
        const bool stuck = since_ear > 2 * left;
        const double bend = since_ear > left ? turn(previous_[corner], corner, after) : 1.0;
        if (stuck || bend == 0.0 || is_ear(previous_[corner], corner, after)) {
            clip(corner);
            --left;
            since_ear = 0;
            // Going on behind the next corner keeps triangles from becoming a fan of slivers.
            corner = next_[after];
        } else {
            ++since_ear;
            corner = after;
        }
    }
    clip(corner);
    return true;
}

}  // namespace weft
