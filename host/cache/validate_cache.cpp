// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/validate_cache.h"

#include <bit>
#include <glm/glm.hpp>

#include "kernels/cache/cache.h"

namespace weft {
namespace {

glm::dvec3 vector_of(const shared::float4& v) {
    return {v.x, v.y, v.z};
}

/// Whether the segment from `from` to `from + way` meets the triangle before its end.
bool meets(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec3& a, const glm::dvec3& b,
           const glm::dvec3& c) {
    const glm::dvec3 p = glm::cross(way, c - a);
    const double determinant = glm::dot(b - a, p);
    if (determinant == 0.0) return false;
    const glm::dvec3 s = from - a;
    const double u = glm::dot(s, p) / determinant;
    if (u < 0.0 || u > 1.0) return false;
    const glm::dvec3 q = glm::cross(s, b - a);
    const double v = glm::dot(way, q) / determinant;
    if (v < 0.0 || u + v > 1.0) return false;
    const double t = glm::dot(c - a, q) / determinant;
    return t > 0.0 && t < 1.0;
}

bool meets_any(const glm::dvec3& from, const glm::dvec3& way, const TriangleSoup& moved) {
    for (const shared::Triangle& t : moved.triangles)
        if (meets(from, way, vector_of(moved.positions[t.v0]), vector_of(moved.positions[t.v1]),
                  vector_of(moved.positions[t.v2])))
            return true;
    return false;
}

}  // namespace

std::uint64_t affected_connections(std::span<const shared::CacheRecord> records,
                                   std::span<const shared::Vpl> vpls,
                                   std::span<const std::uint32_t> changes,
                                   const TriangleSoup& moved) {
    std::uint64_t count = 0;
    for (const shared::CacheRecord& record : records) {
        for (std::size_t i = 0; i < vpls.size(); ++i) {
            const shared::Vpl& vpl = vpls[i];
            if (!(vpl.flux.x > 0.0F || vpl.flux.y > 0.0F || vpl.flux.z > 0.0F)) continue;
            const glm::dvec3 from = vector_of(vpl.position);
            const glm::dvec3 way = vector_of(record.origin) - from;
            const bool facing = glm::dot(way, vector_of(record.normal)) < 0.0 &&
                                (std::bit_cast<std::uint32_t>(vpl.normal.w) != VPL_SURFACE ||
                                 glm::dot(way, vector_of(vpl.normal)) > 0.0);
            if (facing && ((changes[i] & VPL_MOVED) != 0 || meets_any(from, way, moved))) ++count;
        }
    }
    return count;
}

}  // namespace weft
