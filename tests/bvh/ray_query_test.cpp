// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "selftest/hard_rays.h"
#include "tests/testing/bvh_meshes.h"
#include "tests/testing/ray_batch.h"
#include "tests/testing/ray_brute_force.h"
#include "tests/testing/ray_oracle.h"

// The tree must not change what rays meet: every answer has the bits that testing all triangles
// one by one gives, by a second writing of the same arithmetic. Whether that is right, a double
// precision oracle says.
namespace weft::ray_query_test {
namespace {

using test::all_rays;
using test::huge_and_tiny;
using test::RayBatch;
using test::RayGeometry;
using test::RayHit;
using test::rays_huge_and_tiny;
using test::TestBackend;

/// Rays cut off where they hit: the end still is a closest hit, but does not block. Where the
/// distance is not certain (needles seen along their length), it may lie before their boxes, which
/// such a short ray does not reach.
void expect_ends_not_to_block(const test::RayQueries& queries, const RayGeometry& geometry,
                              RayBatch rays, const std::vector<RayHit>& hits,
                              const std::string& where) {
    for (std::size_t i = 0; i < rays.size(); ++i) rays.origins[i].w = hits[i].t;
    const std::vector<RayHit> again = queries.closest(rays);
    const std::vector<int> any = queries.any(rays);
    std::size_t different = 0, blocked = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].triangle == INVALID_INDEX) continue;
        const test::Verdict verdict =
            test::judge(rays.origin(i), rays.direction(i), INFINITY, geometry, hits[i].triangle);
        const bool certain = verdict.high - verdict.low <= 1e-3 * verdict.high;
        different += again[i] == hits[i] || !certain ? 0 : 1;
        blocked += any[i] == 0 ? 0 : 1;
    }
    EXPECT_EQ(different, 0U) << where << ": hits at the end of rays";
    EXPECT_EQ(blocked, 0U) << where << ": rays blocked by their end";
}

/// Shares of the rays that the oracle must find clear, and that must be certain hits.
struct Expected {
    double clear = 0.9;
    double hits = 0.05;
};

void compare(const std::string& name, const RayGeometry& geometry, const RayBatch& rays,
             const Expected& expected = {}) {
    const std::vector<RayHit> all = test::test_all(geometry, rays);
    for (const TestBackend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        const std::vector<RayHit> hits = queries.closest(rays);
        const std::vector<int> any = queries.any(rays);
        const std::string where = name + ", " + test::backend_name(backend);
        if (backend != TestBackend::embree) {
            std::size_t different = 0;
            std::size_t different_any = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                different += hits[i] == all[i] ? 0 : 1;
                // Of a segment that ends in a surface the end is a closest hit, but not blocked.
                const int blocked =
                    all[i].triangle != INVALID_INDEX && all[i].t < rays.origins[i].w;
                different_any += any[i] == blocked ? 0 : 1;
            }
            EXPECT_EQ(different, 0U) << where << ": closest hits of " << rays.size();
            EXPECT_EQ(different_any, 0U) << where << ": blocked rays of " << rays.size();
        }
        const test::OracleCount oracle = test::compare_with_oracle(geometry, rays, hits, any);
        if (backend != TestBackend::embree)
            expect_ends_not_to_block(queries, geometry, rays, hits, where);
        // Embree's own arithmetic finds some hits that are none, right at origins.
        const std::size_t allowed = backend == TestBackend::embree ? rays.size() / 1000 : 0;
        EXPECT_LE(oracle.wrong, allowed) << where << ": against the oracle";
        const auto share = [&](std::size_t n) {
            return static_cast<double>(n) / static_cast<double>(rays.size());
        };
        EXPECT_GE(share(oracle.clear), expected.clear) << where;
        EXPECT_GE(share(oracle.hits), expected.hits) << where;
    }
}

RayGeometry geometry_of(const test::BvhMesh& mesh) {
    return {mesh.positions, mesh.triangles};
}

TEST(RayQuery, ASoupIsMetAsIfEveryTriangleWereTested) {
    for (const float size : {0.3F, 0.05F}) {
        const RayGeometry geometry = geometry_of(test::random_soup(800, size, 3));
        compare("soup", geometry, all_rays(geometry, 3000, 10), {0.9, 0.05});
    }
}

TEST(RayQuery, AGridOfSharedEdgesIsMetAsIfEveryTriangleWereTested) {
    // Rays along its axes go through its edges and are not clear.
    const RayGeometry geometry = geometry_of(test::flat_grid(16));
    compare("grid", geometry, all_rays(geometry, 3000, 20), {0.6, 0.1});
}

TEST(RayQuery, NeedlesAreMetAsIfEveryTriangleWereTested) {
    const RayGeometry geometry = geometry_of(test::diagonal_needles(500, 4));
    compare("needles", geometry, all_rays(geometry, 3000, 30), {0.8, 0.0});
}

TEST(RayQuery, TrianglesThinnerThanFloatsResolveAreMetAsIfEveryTriangleWereTested) {
    const test::BvhMesh mesh = test::thin_needles();
    const RayGeometry geometry = geometry_of(mesh);
    RayBatch rays = all_rays(geometry, 2000, 40);
    test::add_rays_in_planes(rays, 2000, 61);
    compare("needles of 1e-20", geometry, rays, {0.35, 0.02});
}

TEST(RayQuery, HugeAndTinyTrianglesAreMetTogether) {
    const RayGeometry geometry = huge_and_tiny(1.0F);
    ASSERT_LT(std::abs(geometry.positions[0].x), 1e-8F);
    compare("huge and tiny", geometry, rays_huge_and_tiny(1.0F), {0.6, 0.2});
}

TEST(RayQuery, NothingFalseIsMetWhereProductsOfThreeLengthsUnderflow) {
    // Triangles of 10^-6 beside 10^9. Distances have few digits there, or none, so which of two
    // triangles is nearer is not asked; but a hit is finite, and of a triangle on the ray's line.
    const RayGeometry geometry = huge_and_tiny(1e-6F);
    ASSERT_LT(std::abs(geometry.positions[0].x), 1e-14F);
    const RayBatch rays = rays_huge_and_tiny(1e-6F);
    for (const TestBackend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        std::size_t hits = 0, wrong = 0, i = 0;
        for (const RayHit& hit : queries.closest(rays)) {
            if (hit.triangle != INVALID_INDEX) {
                ++hits;
                const test::Verdict verdict = test::judge(rays.origin(i), rays.direction(i),
                                                          INFINITY, geometry, hit.triangle);
                const bool finite =
                    std::isfinite(hit.t) && std::isfinite(hit.u) && std::isfinite(hit.v);
                wrong += finite && verdict.inside > -1e-4 ? 0 : 1;
            }
            ++i;
        }
        EXPECT_EQ(wrong, 0U) << test::backend_name(backend);
        EXPECT_GT(hits, rays.size() / 3);
    }
}

TEST(RayQuery, OfCoincidentTrianglesTheOneWithTheSmallestNumberIsMet) {
    // Five copies, in another order each time and with another first vertex: the tree cannot keep
    // them apart, and rounding must not either.
    test::BvhMesh mesh = test::random_soup(150, 0.3F, 8);
    const std::size_t count = mesh.triangles.size();
    for (std::uint32_t copy = 1; copy < 5; ++copy)
        for (std::size_t i = 0; i < count; ++i)
            mesh.triangles.push_back(mesh.triangles[(i * 7 + copy) % count]);
    const RayGeometry geometry = geometry_of(mesh);
    const RayBatch rays = all_rays(geometry, 4000, 50);
    // All copies are equally far, so no hit is clear to the oracle.
    compare("coincident", geometry, rays, {0.3, 0.0});
    for (const TestBackend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        std::size_t hits = 0;
        std::size_t wrong = 0;
        for (const RayHit& hit : queries.closest(rays)) {
            hits += hit.triangle != INVALID_INDEX ? 1 : 0;
            wrong += hit.triangle != INVALID_INDEX && hit.triangle >= count ? 1 : 0;
        }
        // Where only Embree's arithmetic meets a triangle, its tree chooses.
        EXPECT_LE(wrong, backend == TestBackend::embree ? hits / 1000 : 0)
            << test::backend_name(backend);
        EXPECT_GT(hits, rays.size() / 10);
    }
}

TEST(RayQuery, TrianglesWithoutAreaAreNeverMet) {
    const test::BvhMesh mesh = test::triangles_without_area();
    const RayGeometry geometry = geometry_of(mesh);
    RayBatch rays = all_rays(geometry, 1000, 60);
    test::add_rays_at_flat_triangles(rays, geometry, 20000, 91);
    for (const TestBackend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        const std::vector<int> any = queries.any(rays);
        const std::vector<RayHit> hits = queries.closest(rays);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            wrong += hits[i].triangle != INVALID_INDEX && hits[i].triangle != 0 ? 1 : 0;
            wrong += any[i] == (hits[i].triangle == 0 ? 1 : 0) ? 0 : 1;
        }
        EXPECT_EQ(wrong, 0U) << test::backend_name(backend);
    }
}

}  // namespace
}  // namespace weft::ray_query_test
