// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/convex_media.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace weft {
namespace {

struct Plane {
    glm::dvec3 normal;
    double offset = 0.0;

    [[nodiscard]] double height(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

struct Hull {
    std::vector<glm::dvec3> vertices;  ///< three of each triangle
    std::vector<Plane> planes;
};

// More than rounding has moved vertices; anything thinner is not resolved.
double tolerance_of(const FlatMedia& media) {
    return 4.0 * static_cast<double>(media.space.rounding);
}

glm::dvec3 vertex(const FlatMedia& media, std::uint32_t index) {
    const shared::float4& p = media.positions[index];
    return {p.x, p.y, p.z};
}

std::vector<Hull> hulls_of(const FlatMedia& media) {
    std::vector<Hull> hulls(media.space.boundaries);
    for (const shared::Triangle& t : media.triangles)
        for (const std::uint32_t index : {t.v0, t.v1, t.v2})
            hulls[t.instance].vertices.push_back(vertex(media, index));
    return hulls;
}

// Whether every edge has as many triangles in one direction as in the other. Vertices at the same
// place count as one.
bool is_closed(const Hull& hull) {
    const auto before = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<glm::dvec3, int, decltype(before)> numbers(before);
    std::map<std::pair<int, int>, int> edges;
    const auto number = [&](const glm::dvec3& p) {
        return numbers.emplace(p, static_cast<int>(numbers.size())).first->second;
    };
    for (std::size_t i = 0; i < hull.vertices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = number(hull.vertices[i + k]);
            const int b = number(hull.vertices[i + (k + 1) % 3]);
            if (a < b) ++edges[{a, b}];
            if (b < a) --edges[{b, a}];
        }
    }
    return std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; });
}

// The planes of the faces; more than kernels have room for where there are too many.
std::vector<Plane> planes_of(const Hull& hull, double tolerance) {
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < hull.vertices.size() && planes.size() <= CONVEX_PLANES; i += 3) {
        const glm::dvec3& a = hull.vertices[i];
        const glm::dvec3& b = hull.vertices[i + 1];
        const glm::dvec3& c = hull.vertices[i + 2];
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        if (!(glm::length(normal) > 0.0)) continue;
        Plane plane{glm::normalize(normal), 0.0};
        plane.offset = glm::dot(plane.normal, a);
        const bool known = std::any_of(planes.begin(), planes.end(), [&](const Plane& p) {
            return glm::dot(p.normal, plane.normal) > 0.0 &&
                   std::max({std::abs(p.height(a)), std::abs(p.height(b)),
                             std::abs(p.height(c))}) <= tolerance;
        });
        if (!known) planes.push_back(plane);
    }
    return planes;
}

// Puts parallel planes that face away from each other one after the other, with normals that are
// negatives of each other to the last bit.
void pair_planes(Hull& hull, double tolerance) {
    std::vector<Plane>& planes = hull.planes;
    for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
        Plane opposite{-planes[i].normal, -HUGE_VAL};
        for (const glm::dvec3& v : hull.vertices)
            opposite.offset = std::max(opposite.offset, glm::dot(opposite.normal, v));
        // A face lies in that plane if its own plane holds the same vertices.
        const auto same = [&](const Plane& plane) {
            return glm::dot(plane.normal, opposite.normal) > 0.0 &&
                   std::all_of(
                       hull.vertices.begin(), hull.vertices.end(), [&](const glm::dvec3& v) {
                           return std::abs(plane.height(v) - opposite.height(v)) <= tolerance;
                       });
        };
        const auto next = planes.begin() + static_cast<std::ptrdiff_t>(i) + 1;
        const auto found = std::find_if(next, planes.end(), same);
        if (found == planes.end()) continue;
        *found = opposite;
        std::iter_swap(next, found);
        ++i;
    }
}

bool all_below(const Hull& hull, const Plane& plane, double tolerance) {
    return std::all_of(hull.vertices.begin(), hull.vertices.end(),
                       [&](const glm::dvec3& v) { return plane.height(v) <= tolerance; });
}

bool all_above(const Hull& hull, const Plane& plane, double tolerance) {
    return std::all_of(hull.vertices.begin(), hull.vertices.end(),
                       [&](const glm::dvec3& v) { return plane.height(v) >= -tolerance; });
}

bool is_inside(const Hull& hull, const Hull& of, double tolerance) {
    return std::all_of(of.planes.begin(), of.planes.end(),
                       [&](const Plane& plane) { return all_below(hull, plane, tolerance); });
}

// Whether a face of one hull separates them. False also for hulls that only edges separate.
bool are_apart(const Hull& a, const Hull& b, double tolerance) {
    const auto part = [&](const Hull& of, const Hull& from) {
        return std::any_of(of.planes.begin(), of.planes.end(),
                           [&](const Plane& plane) { return all_above(from, plane, tolerance); });
    };
    return part(a, b) || part(b, a);
}

// At least four planes, as a tetrahedron has.
bool is_convex(const Hull& hull, double tolerance) {
    return hull.planes.size() >= 4 && is_closed(hull) && is_inside(hull, hull, tolerance);
}

bool has_grid(const FlatMedia& media, std::uint32_t medium) {
    return medium != NO_MEDIUM && media.records[medium].grid != INVALID_INDEX;
}

// Finds the next hull around each; false where two are neither apart nor one inside of the other.
// Later hulls have larger volumes.
bool find_around(const FlatMedia& media, const std::vector<Hull>& hulls, double tolerance,
                 std::array<std::uint32_t, CONVEX_BOUNDARIES>& around) {
    around.fill(NO_MEDIUM);
    for (std::size_t j = 0; j < hulls.size(); ++j) {
        for (std::size_t k = j + 1; k < hulls.size(); ++k) {
            const bool inside = is_inside(hulls[j], hulls[k], tolerance);
            if (!inside && !are_apart(hulls[j], hulls[k], tolerance)) return false;
            if (inside && has_grid(media, media.space.interior[k])) return false;
            if (inside && around.at(j) == NO_MEDIUM) around.at(j) = static_cast<std::uint32_t>(k);
        }
    }
    return true;
}

}  // namespace

void find_convex_boundaries(FlatMedia& media) {
    shared::MediaRecord& space = media.space;
    space.convex = 0;
    if (space.boundaries > CONVEX_BOUNDARIES || has_grid(media, space.outside)) return;
    const double tolerance = tolerance_of(media);
    std::vector<Hull> hulls = hulls_of(media);
    std::size_t planes = 0;
    for (Hull& hull : hulls) {
        hull.planes = planes_of(hull, tolerance);
        planes += hull.planes.size();
        if (planes > CONVEX_PLANES || !is_convex(hull, tolerance)) return;
        pair_planes(hull, tolerance);
    }
    std::array<std::uint32_t, CONVEX_BOUNDARIES> around{};
    if (!find_around(media, hulls, tolerance, around)) return;
    std::copy(around.begin(), around.end(), std::begin(space.around));
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < hulls.size(); ++k) {
        for (const Plane& plane : hulls[k].planes) {
            const glm::vec3 n(plane.normal);
            space.planes[next++] = {n.x, n.y, n.z, static_cast<float>(plane.offset)};
        }
        space.plane_end[k] = next;
    }
    space.convex = 1;
}

}  // namespace weft
