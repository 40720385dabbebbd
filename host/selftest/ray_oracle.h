// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_RAY_ORACLE_H
#define WEFT_SELFTEST_RAY_ORACLE_H

#include <algorithm>
#include <cmath>
#include <optional>

#include "selftest/ray_batch.h"

// Tells in double precision what a ray hits, with bounds on the errors of float arithmetic: it
// answers only where no rounding in the kernels can change the answer.
namespace weft::selftest {

/// Whether a ray hits a triangle, and at what distance, which is certain within [low, high].
struct Verdict {
    bool may_hit = false;
    bool must_hit = false;
    double low = 0.0;
    double high = 0.0;
    /// Smallest of the barycentric coordinates on the triangle's plane; negative outside.
    double inside = -INFINITY;
};

/// Bound on the error of an edge function in floats, relative to the product of lengths: three
/// differences, two products with a shear or a cross product, and sums, each rounded by 2^-24.
constexpr double oracle_rounding = 0x1p-19;

inline Verdict judge(const glm::dvec3& origin, const glm::dvec3& direction, double t_max,
                     const RayGeometry& geometry, std::uint32_t triangle) {
    const glm::dvec3 a = geometry.corner(triangle, 0) - origin;
    const glm::dvec3 b = geometry.corner(triangle, 1) - origin;
    const glm::dvec3 c = geometry.corner(triangle, 2) - origin;
    const double length = glm::length(direction);
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    const std::array edge{glm::dot(direction, glm::cross(c, b)),
                          glm::dot(direction, glm::cross(a, c)),
                          glm::dot(direction, glm::cross(b, a))};
    // Floats lose all relative precision below 2^-126.
    const double least = 0x1p-120 * length;
    const std::array slack{oracle_rounding * length * lc * lb + least,
                           oracle_rounding * length * la * lc + least,
                           oracle_rounding * length * lb * la + least};
    int surely_positive = 0;
    int surely_negative = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        surely_positive += edge[k] > slack[k] ? 1 : 0;
        surely_negative += edge[k] < -slack[k] ? 1 : 0;
    }
    Verdict verdict;
    if (surely_positive > 0 && surely_negative > 0) return verdict;
    const double sum = edge[0] + edge[1] + edge[2];
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double t = glm::dot(a, n) / glm::dot(direction, n);
    const double reach = std::max({la, lb, lc}) / length;
    const double error = 4.0 * (slack[0] + slack[1] + slack[2]) / std::abs(sum) * reach +
                         oracle_rounding * std::abs(t);
    verdict.inside = std::min({edge[0] / sum, edge[1] / sum, edge[2] / sum});
    verdict.may_hit = true;
    if (!std::isfinite(t) || !std::isfinite(error)) {
        verdict.high = INFINITY;
        return verdict;
    }
    verdict.low = t - error;
    verdict.high = t + error;
    if (verdict.high <= 0.0 || verdict.low > t_max) verdict.may_hit = false;
    verdict.must_hit = verdict.may_hit && (surely_positive == 3 || surely_negative == 3) &&
                       verdict.low > 0.0 && verdict.high < t_max;
    return verdict;
}

/// The first hit of a ray.
struct ClosestVerdict {
    std::optional<std::uint32_t> triangle;  // INVALID_INDEX for a certain miss; none where unclear
    double low = 0.0;
    double high = INFINITY;
    bool may_hit_any = false;
    bool must_hit_any = false;
};

inline ClosestVerdict judge_closest(const RayGeometry& geometry, const glm::dvec3& origin,
                                    const glm::dvec3& direction, double t_max) {
    ClosestVerdict closest;
    std::uint32_t first = INVALID_INDEX;
    double runner_up = INFINITY;  // least possible distance of any other triangle
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const Verdict v = judge(origin, direction, t_max, geometry, i);
        if (!v.may_hit) continue;
        closest.may_hit_any = true;
        closest.must_hit_any = closest.must_hit_any || v.must_hit;
        if (v.must_hit && v.high < closest.high) {
            if (first != INVALID_INDEX) runner_up = std::min(runner_up, closest.low);
            first = i;
            closest.low = v.low;
            closest.high = v.high;
        } else {
            runner_up = std::min(runner_up, v.low);
        }
    }
    if (!closest.may_hit_any) closest.triangle = INVALID_INDEX;
    if (first != INVALID_INDEX && closest.high < runner_up) closest.triangle = first;
    return closest;
}

/// Numbers of rays: those with a certain answer, wrong answers, and certain hits.
struct OracleCount {
    std::size_t clear = 0;
    std::size_t wrong = 0;
    std::size_t hits = 0;
};

/// Counts the rays on which the oracle is certain, and answers that contradict it.
inline OracleCount compare_with_oracle(const RayGeometry& geometry, const RayBatch& rays,
                                       const std::vector<RayHit>& hits,
                                       const std::vector<int>& any) {
    OracleCount count;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ClosestVerdict v = judge_closest(geometry, rays.origin(i), rays.direction(i),
                                               static_cast<double>(rays.origins[i].w));
        if (v.must_hit_any) count.wrong += any[i] == 1 ? 0 : 1;
        if (!v.may_hit_any) count.wrong += any[i] == 0 ? 0 : 1;
        if (!v.triangle) continue;
        ++count.clear;
        if (*v.triangle == INVALID_INDEX) {
            count.wrong += hits[i].triangle == INVALID_INDEX ? 0 : 1;
            continue;
        }
        ++count.hits;
        const double t = static_cast<double>(hits[i].t);
        count.wrong += hits[i].triangle == *v.triangle && t >= v.low && t <= v.high ? 0 : 1;
    }
    return count;
}

}  // namespace weft::selftest

#endif
