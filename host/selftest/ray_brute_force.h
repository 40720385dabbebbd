// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_RAY_BRUTE_FORCE_H
#define WEFT_SELFTEST_RAY_BRUTE_FORCE_H

#include <array>
#include <utility>
#include <vector>

#include "selftest/ray_batch.h"

// Reference implementation of closest hits: tests every triangle, in the same arithmetic as
// kernels/bvh/triangle.h but written independently.
namespace weft::selftest {

/// Whether a triangle has area: the builder of trees leaves the others out.
inline bool has_area(const RayGeometry& geometry, std::uint32_t i) {
    const glm::dvec3 a = geometry.corner(i, 0);
    return glm::cross(geometry.corner(i, 1) - a, geometry.corner(i, 2) - a) != glm::dvec3(0.0);
}

/// The watertight test of Woop, Benthin and Wald in floats, one ray against one triangle.
class ShearedRay {
  public:
    ShearedRay(const shared::float4& origin, const shared::float4& direction)
        : origin_(origin.x, origin.y, origin.z) {
        const glm::vec3 d(direction.x, direction.y, direction.z);
        const glm::vec3 size = glm::abs(d);
        z_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        x_ = (z_ + 1) % 3;
        y_ = (z_ + 2) % 3;
        if (d[z_] < 0.0F) std::swap(x_, y_);
        shear_ = {d[x_] / d[z_], d[y_] / d[z_], 1.0F / d[z_]};
    }

    /// Whether the ray hits the triangle within (0, t_max]; then fills all of `hit` but its number.
    bool meets(const std::array<glm::vec3, 3>& corners, float t_max, RayHit& hit) const {
        const glm::vec3 a = sheared(corners[0]);
        const glm::vec3 b = sheared(corners[1]);
        const glm::vec3 c = sheared(corners[2]);
        const float u = c.x * b.y - c.y * b.x;
        const float v = a.x * c.y - a.y * c.x;
        const float w = b.x * a.y - b.y * a.x;
        const bool below = u < 0.0F || v < 0.0F || w < 0.0F;
        const bool above = u > 0.0F || v > 0.0F || w > 0.0F;
        const float sum = u + v + w;
        if ((below && above) || sum == 0.0F) return false;
        const float t = shear_.z * (u / sum * a.z + v / sum * b.z + w / sum * c.z);
        if (!(t > 0.0F && t <= t_max)) return false;
        hit = {hit.triangle, t, v / sum, w / sum};
        return true;
    }

  private:
    [[nodiscard]] glm::vec3 sheared(const glm::vec3& p) const {
        const glm::vec3 q = p - origin_;
        return {q[x_] - shear_.x * q[z_], q[y_] - shear_.y * q[z_], q[z_]};
    }

    glm::vec3 origin_;
    glm::vec3 shear_{0.0F};
    int x_ = 0;
    int y_ = 1;
    int z_ = 2;
};

/// Whether a hit lies in the box of its triangle. Seen from afar, the corners of a tiny triangle
/// differ by rounding alone, so that rays anywhere may seem to hit it; the boxes of a tree rule
/// such hits out.
inline bool in_box(const std::array<glm::vec3, 3>& corners, const RayBatch& rays, std::size_t ray,
                   float t, float extent) {
    const glm::vec3 p(rays.origin(ray) + static_cast<double>(t) * rays.direction(ray));
    const glm::vec3 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::vec3 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
    const glm::vec3 margin(1e-4F * extent);
    return glm::all(glm::greaterThanEqual(p, low - margin)) &&
           glm::all(glm::lessThanEqual(p, high + margin));
}

/// Closest hits without any tree.
inline std::vector<RayHit> test_all(const RayGeometry& geometry, const RayBatch& rays) {
    std::vector<std::array<glm::vec3, 3>> corners;
    std::vector<std::uint32_t> ids;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        if (!has_area(geometry, i)) continue;
        ids.push_back(i);
        corners.push_back({glm::vec3(geometry.corner(i, 0)), glm::vec3(geometry.corner(i, 1)),
                           glm::vec3(geometry.corner(i, 2))});
    }
    const float extent = geometry.extent();
    std::vector<RayHit> hits;
    for (std::size_t r = 0; r < rays.size(); ++r) {
        const ShearedRay ray(rays.origins[r], rays.directions[r]);
        RayHit best{INVALID_INDEX, rays.origins[r].w, 0.0F, 0.0F};
        for (std::size_t i = 0; i < ids.size(); ++i) {
            RayHit hit{ids[i], 0.0F, 0.0F, 0.0F};
            if (ray.meets(corners[i], best.t, hit) &&
                (hit.t < best.t || hit.triangle < best.triangle) &&
                in_box(corners[i], rays, r, hit.t, extent))
                best = hit;
        }
        hits.push_back(best);
    }
    return hits;
}

}  // namespace weft::selftest

#endif
