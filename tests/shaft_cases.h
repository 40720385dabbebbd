// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_SHAFT_CASES_H
#define WEFT_TESTS_SHAFT_CASES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bvh_meshes.h"
#include "ray_batch.h"

// Shafts to ask about, and what they are judged by.
namespace weft::test {

/// A shaft as query_shaft reads it.
struct ShaftRecord {
    shared::float4 a_low, a_high, b_low, b_high;
    shared::float4 receiver_plane, light_plane;
};
static_assert(sizeof(ShaftRecord) == 6 * sizeof(shared::float4));

inline shared::float4 as_float4(const glm::dvec3& v, double w = 0.0) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
            static_cast<float>(w)};
}

/// 1 for every shaft that is proven open. The extent is that of the geometry.
inline std::vector<std::uint32_t> query_shafts(Executor& executor, const RayGeometry& geometry,
                                               const std::vector<ShaftRecord>& records) {
    constexpr std::array kernels{KernelId::query_shaft};
    executor.build(kernels, 0);
    const auto scene =
        executor.make_scene({geometry.positions, geometry.triangles, geometry.extent() * 0x1p-22F});
    const auto shafts = upload<ShaftRecord>(executor, records, "shafts");
    const std::vector<std::uint32_t> unset(records.size(), 7);
    const auto open = upload<std::uint32_t>(executor, unset, "answers");
    shared::Params params{};
    params.extent = geometry.extent();
    const std::array<Buffer*, 2> buffers{shafts.get(), open.get()};
    executor.run({KernelId::query_shaft, params, scene.get(), buffers,
                  static_cast<std::uint32_t>(records.size()), 0},
                 {});
    (void)executor.take_milliseconds();
    return read_buffer<std::uint32_t>(executor, *open, records.size());
}

/// How far rays start off their surface at most (surface_offset).
inline double largest_offset(const RayGeometry& geometry) {
    return 24.0 * 0x1p-24 * static_cast<double>(geometry.extent());
}

/// Where one end of a segment may be: in a box, or on a planar triangle.
struct Region {
    std::array<glm::dvec3, 3> corners;  // lower and upper corner of the box, or of the triangle
    bool planar = false;
    glm::dvec3 normal{0.0};  // of the triangle, toward the other region

    [[nodiscard]] glm::dvec3 low() const {
        return planar ? glm::min(glm::min(corners[0], corners[1]), corners[2]) : corners[0];
    }
    [[nodiscard]] glm::dvec3 high() const {
        return planar ? glm::max(glm::max(corners[0], corners[1]), corners[2]) : corners[1];
    }
    [[nodiscard]] glm::dvec3 middle() const { return 0.5 * (low() + high()); }
    [[nodiscard]] double height(const glm::dvec3& p) const {
        return glm::dot(normal, p - corners[0]);
    }
    /// A point, on the border every other time; in front of the triangle by `offset`.
    [[nodiscard]] glm::dvec3 point(Uniform& uniform, double offset) const {
        glm::dvec3 t{0.0};
        for (int k = 0; k < 3; ++k) {
            t[k] = static_cast<double>(uniform(0.0F, 1.0F));
            if (uniform(0.0F, 1.0F) < 0.5F) t[k] = std::round(t[k]);
        }
        if (!planar) return corners[0] + t * (corners[1] - corners[0]);
        if (t.x + t.y > 1.0) t = {1.0 - t.x, 1.0 - t.y, 0.0};
        return corners[0] + t.x * (corners[1] - corners[0]) + t.y * (corners[2] - corners[0]) +
               offset * normal;
    }
    /// The plane of a triangle, as a shaft takes it.
    [[nodiscard]] shared::float4 plane() const {
        return planar ? as_float4(normal, glm::dot(normal, corners[0])) : shared::float4{};
    }
};

struct ShaftCases {
    std::vector<ShaftRecord> records;
    std::vector<std::pair<Region, Region>> regions;
};

/// A box of the size of the scene or far less; flat, or a point, at times.
inline Region random_box(const glm::dvec3& low, const glm::dvec3& high, Uniform& uniform) {
    Region region;
    glm::dvec3 at{0.0};
    glm::dvec3 size{0.0};
    const double scale = std::pow(10.0, static_cast<double>(uniform(-3.0F, -0.4F)));
    for (int k = 0; k < 3; ++k) {
        at[k] = static_cast<double>(uniform(-0.3F, 1.2F));
        size[k] = scale * static_cast<double>(uniform(0.0F, 1.0F));
        if (uniform(0.0F, 1.0F) < 0.2F) size[k] = 0.0;
    }
    const shared::float4 lower = as_float4(low + at * (high - low));
    const shared::float4 upper = as_float4(low + (at + size) * (high - low));
    region.corners[0] = {lower.x, lower.y, lower.z};
    region.corners[1] = {upper.x, upper.y, upper.z};
    return region;
}

/// Part of a triangle of the scene, such as a tile of receivers or a lamp.
inline Region random_part(const RayGeometry& geometry, Uniform& uniform) {
    Region region;
    region.planar = true;
    const double count = static_cast<double>(geometry.triangles.size());
    const auto triangle = static_cast<std::uint32_t>(
        std::min(count - 1.0, count * static_cast<double>(uniform(0.0F, 1.0F))));
    const glm::dvec3 a = geometry.corner(triangle, 0);
    const glm::dvec3 b = geometry.corner(triangle, 1);
    const glm::dvec3 c = geometry.corner(triangle, 2);
    const double share = static_cast<double>(uniform(0.05F, 1.0F));
    region.corners = {a, a + share * (b - a), a + share * (c - a)};
    region.normal = glm::normalize(glm::cross(b - a, c - a));
    return region;
}

/// Regions of both kinds in and about the scene.
inline ShaftCases random_shafts(const RayGeometry& geometry, std::size_t count,
                                std::uint32_t seed) {
    Uniform uniform(seed);
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, geometry.corner(i, k));
            high = glm::max(high, geometry.corner(i, k));
        }
    ShaftCases cases;
    const auto outward = [&](const glm::dvec3& v, float to) {
        shared::float4 r = as_float4(v);
        return shared::float4{std::nextafter(r.x, to), std::nextafter(r.y, to),
                              std::nextafter(r.z, to), 0.0F};
    };
    for (std::size_t i = 0; i < count; ++i) {
        Region a = i % 2 == 0 ? random_box(low, high, uniform) : random_part(geometry, uniform);
        Region b = i % 4 < 2 ? random_box(low, high, uniform) : random_part(geometry, uniform);
        // Every other receiver has a light near it, as most open shafts have.
        if (!b.planar && i % 8 < 4) {
            const glm::dvec3 step = 0.6 * (a.middle() - b.middle());
            for (glm::dvec3& corner : b.corners) corner += step;
        }
        if (a.height(b.middle()) < 0.0) a.normal = -a.normal;
        if (b.height(a.middle()) < 0.0) b.normal = -b.normal;
        constexpr float up = std::numeric_limits<float>::max();
        cases.records.push_back({outward(a.low(), -up), outward(a.high(), up),
                                 outward(b.low(), -up), outward(b.high(), up), a.plane(),
                                 b.plane()});
        cases.regions.emplace_back(a, b);
    }
    return cases;
}

/// Whether the closed segment from p to q meets a triangle (Moeller and Trumbore, in double).
inline bool meets_any(const RayGeometry& geometry, const glm::dvec3& p, const glm::dvec3& q) {
    const glm::dvec3 d = q - p;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const glm::dvec3 a = geometry.corner(i, 0);
        const glm::dvec3 side = geometry.corner(i, 1) - a;
        const glm::dvec3 other = geometry.corner(i, 2) - a;
        const glm::dvec3 across = glm::cross(d, other);
        const double scale = glm::dot(side, across);
        if (scale == 0.0) continue;
        const double u = glm::dot(p - a, across) / scale;
        if (!(u >= 0.0 && u <= 1.0)) continue;
        const glm::dvec3 along = glm::cross(p - a, side);
        const double v = glm::dot(d, along) / scale;
        const double t = glm::dot(other, along) / scale;
        if (v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t <= 1.0) return true;
    }
    return false;
}

/// Of `count` random segments of shaft `i` how many are blocked. Ends that lie behind the other
/// region's plane make no segment.
inline std::size_t blocked_segments(const RayGeometry& geometry, const ShaftCases& cases,
                                    std::size_t i, std::size_t count, Uniform& uniform) {
    const auto& [a, b] = cases.regions[i];
    const double offset = largest_offset(geometry);
    std::size_t blocked = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const glm::dvec3 p = a.point(uniform, offset);
        const glm::dvec3 q = b.point(uniform, offset);
        if (a.planar && a.height(q) < offset) continue;
        if (b.planar && b.height(p) < offset) continue;
        blocked += meets_any(geometry, p, q) ? 1 : 0;
    }
    return blocked;
}

}  // namespace weft::test

#endif
