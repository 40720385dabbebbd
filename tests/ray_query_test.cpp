// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bvh_meshes.h"
#include "ray_batch.h"
#include "ray_brute_force.h"
#include "ray_oracle.h"

// The tree must not change what rays meet: every answer has the bits that testing all triangles
// one by one gives, by a second writing of the same arithmetic. Whether that is right, a double
// precision oracle says.
namespace weft {
namespace {

using test::Backend;
using test::RayBatch;
using test::RayGeometry;
using test::RayHit;
using test::Uniform;

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
        if (hits[i].triangle == NO_TRIANGLE) continue;
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
    for (const Backend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        const std::vector<RayHit> hits = queries.closest(rays);
        const std::vector<int> any = queries.any(rays);
        const std::string where = name + ", " + test::backend_name(backend);
        if (backend != Backend::embree) {
            std::size_t different = 0;
            std::size_t different_any = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                different += hits[i] == all[i] ? 0 : 1;
                // Of a segment that ends in a surface the end is a closest hit, but not blocked.
                const int blocked = all[i].triangle != NO_TRIANGLE && all[i].t < rays.origins[i].w;
                different_any += any[i] == blocked ? 0 : 1;
            }
            EXPECT_EQ(different, 0U) << where << ": closest hits of " << rays.size();
            EXPECT_EQ(different_any, 0U) << where << ": blocked rays of " << rays.size();
        }
        const test::OracleCount oracle = test::compare_with_oracle(geometry, rays, hits, any);
        if (backend != Backend::embree)
            expect_ends_not_to_block(queries, geometry, rays, hits, where);
        // Embree's own arithmetic finds some hits that are none, right at origins.
        const std::size_t allowed = backend == Backend::embree ? rays.size() / 1000 : 0;
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

glm::vec3 random_point(Uniform& uniform, float low, float high) {
    const float x = uniform(low, high);
    const float y = uniform(low, high);
    return {x, y, uniform(low, high)};
}

std::size_t random_index(Uniform& uniform, std::size_t count) {
    return std::min(count - 1,
                    static_cast<std::size_t>(uniform(0.0F, 1.0F) * static_cast<float>(count)));
}

/// From around the unit cube; every second one ends at a random distance.
void add_random(RayBatch& rays, std::size_t count, std::uint32_t seed) {
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        const glm::vec3 target = random_point(uniform, 0.0F, 1.0F);
        const float length = std::exp2(std::floor(uniform(-10.0F, 10.0F)));
        rays.add(origin, (target - origin) * length,
                 i % 2 == 0 ? test::ray_infinity : uniform(0.0F, 2.0F) / length);
    }
}

/// Along axes, the other components of the direction zero, negative zero or denormal, the origin
/// level with vertices.
void add_axis_aligned(RayBatch& rays, const RayGeometry& geometry, std::size_t count,
                      std::uint32_t seed) {
    // In the plane of a triangle nothing but -0 and 0 is exact: there slopes stay above what
    // underflows when edge functions multiply it.
    constexpr std::array small{
        0.0F,    -0.0F,  1e-19F,  -1e-30F, std::numeric_limits<float>::denorm_min(),
        -1e-45F, 1e-40F, -1e-39F, 2e-38F};
    constexpr std::size_t above_underflow = 4;
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        glm::vec3 direction(0.0F);
        const int axis = static_cast<int>(i % 3);
        for (int k = 0; k < 3; ++k) {
            direction[k] =
                small.at(random_index(uniform, i % 4 == 0 ? above_underflow : small.size()));
            const shared::float4& p =
                geometry.positions[random_index(uniform, geometry.positions.size())];
            if (i % 4 == 0) origin[k] = k == 0 ? p.x : (k == 1 ? p.y : p.z);
        }
        origin[axis] = i % 2 == 0 ? -0.5F : 1.5F;
        direction[axis] = i % 2 == 0 ? 1.0F : -1.0F;
        rays.add(origin, direction);
    }
}

/// Origins on planes and corners of the boxes of the tree and rays through their corners.
void add_box_rays(RayBatch& rays, const RayGeometry& geometry, std::size_t count,
                  std::uint32_t seed) {
    BvhSettings settings;
    settings.padding = geometry.extent() * 0x1p-22F;
    const WideBvh bvh = build_bvh(geometry.positions, geometry.triangles, settings);
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count;) {
        const shared::BvhNode& node = bvh.nodes[random_index(uniform, bvh.nodes.size())];
        const std::size_t child = random_index(uniform, 8);
        if (node.child[child] == BVH_EMPTY) continue;
        glm::vec3 corner(0.0F);
        for (int k = 0; k < 3; ++k)
            corner[k] = node.bounds[2 * k + (uniform(0.0F, 1.0F) < 0.5F ? 0 : 1)][child];
        glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        glm::vec3 direction = random_point(uniform, -1.0F, 1.0F);
        const int axis = static_cast<int>(random_index(uniform, 3));
        switch (i % 4) {
            case 0:  // through a corner
                direction = corner - origin;
                break;
            case 1:  // from a corner
                origin = corner;
                break;
            case 2:  // from a plane
                origin[axis] = corner[axis];
                break;
            default:  // in a plane
                origin[axis] = corner[axis];
                direction[axis] = i % 8 == 3 ? 0.0F : -0.0F;
                break;
        }
        rays.add(origin, direction);
        ++i;
    }
}

RayBatch all_rays(const RayGeometry& geometry, std::size_t count, std::uint32_t seed) {
    RayBatch rays;
    add_random(rays, count, seed);
    add_axis_aligned(rays, geometry, count, seed + 1);
    add_box_rays(rays, geometry, count, seed + 2);
    return rays;
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
    // Beside coordinate 0, the only place where floats are fine enough.
    test::BvhMesh mesh = test::random_soup(100, 0.2F, 5);
    Uniform uniform(6);
    for (std::size_t i = 0; i < 300; ++i) {
        std::array<std::array<float, 3>, 3> v{};
        const std::size_t thin = i % 3;
        const std::size_t across = (i + 1) % 3;
        const std::size_t along = (i + 2) % 3;
        const float y = uniform(0.0F, 1.0F);
        const float x = uniform(0.0F, 1.0F);
        for (std::size_t k = 0; k < 3; ++k) v[k][across] = y;
        v[0][along] = x;
        v[1][along] = x + uniform(0.1F, 0.5F);
        v[2][along] = x + 0.1F;
        v[2][thin] = 1e-20F;
        mesh.add(v[0], v[1], v[2]);
    }
    const RayGeometry geometry = geometry_of(mesh);
    RayBatch rays = all_rays(geometry, 2000, 40);
    // In the planes of the needles, where only they can be met.
    for (std::size_t i = 0; i < 2000; ++i) {
        glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        glm::vec3 direction = random_point(uniform, -1.0F, 1.0F);
        origin[static_cast<int>(i % 3)] = i % 2 == 0 ? 0.0F : 5e-21F;
        direction[static_cast<int>(i % 3)] = 0.0F;
        rays.add(origin, direction);
    }
    compare("needles of 1e-20", geometry, rays, {0.35, 0.02});
}

/// 200 triangles of about `size` in the middle of 50 whose coordinates reach 10^9.
RayGeometry huge_and_tiny(float size) {
    Mesh mesh;
    Uniform uniform(7);
    const auto add = [&](const glm::vec3& middle, float reach) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(middle + random_point(uniform, -reach, reach));
        mesh.triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < 200; ++i) add(random_point(uniform, -3.0F * size, 3.0F * size), size);
    for (int i = 0; i < 50; ++i) add(random_point(uniform, -5e8F, 5e8F), 4e8F);
    // Two far corners make the middle of the tiny triangles that of the scene.
    for (const float end : {-1e9F, 1e9F}) {
        add(glm::vec3(0.5F * end), 1e7F);
        mesh.positions.back() = glm::vec3(end);
    }
    test::SceneBuilder builder;
    builder.add(mesh, builder.material(glm::vec3(0.5F)));
    return test::geometry_of(flatten(builder.scene));
}

/// Two thirds from among the tiny triangles, the others from among the huge ones.
RayBatch rays_huge_and_tiny(float size) {
    Uniform uniform(8);
    const float tiny = std::ldexp(size, -29);  // 10^9 becomes 2^0 and a bit
    RayBatch rays;
    for (std::size_t i = 0; i < 6000; ++i) {
        const bool near = i % 3 != 0;
        const glm::vec3 origin = random_point(uniform, -1.0F, 1.0F) * (near ? 6.0F * tiny : 1.0F);
        const glm::vec3 target = random_point(uniform, -1.0F, 1.0F) * (near ? 3.0F * tiny : 1.0F);
        rays.add(origin, i % 2 == 0 ? glm::normalize(target - origin) : target - origin);
    }
    return rays;
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
    for (const Backend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        std::size_t hits = 0, wrong = 0, i = 0;
        for (const RayHit& hit : queries.closest(rays)) {
            if (hit.triangle != NO_TRIANGLE) {
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
    for (const Backend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        std::size_t hits = 0;
        std::size_t wrong = 0;
        for (const RayHit& hit : queries.closest(rays)) {
            hits += hit.triangle != NO_TRIANGLE ? 1 : 0;
            wrong += hit.triangle != NO_TRIANGLE && hit.triangle >= count ? 1 : 0;
        }
        // Where only Embree's arithmetic meets a triangle, its tree chooses.
        EXPECT_LE(wrong, backend == Backend::embree ? hits / 1000 : 0)
            << test::backend_name(backend);
        EXPECT_GT(hits, rays.size() / 10);
    }
}

TEST(RayQuery, TrianglesWithoutAreaAreNeverMet) {
    // Corners on a grid of 1/256, so that points in a line are so exactly; one triangle with area
    // keeps the tree from being empty.
    test::BvhMesh mesh;
    Uniform uniform(9);
    mesh.add({0.0F, 0.0F, 0.0F}, {0.01F, 0.0F, 0.0F}, {0.0F, 0.01F, 0.0F});
    const auto grid = [&](float range) {
        return std::round(uniform(0.0F, range) * 256.0F) / 256.0F;
    };
    for (int i = 0; i < 300; ++i) {
        const std::array a{grid(0.5F), grid(0.5F), grid(0.5F)};
        std::array b = a;
        std::array c = a;
        for (std::size_t k = 0; k < 3 && i % 3 != 0; ++k) {
            const float step = grid(0.2F);
            b[k] += i % 3 == 1 ? step : 2.0F * step;  // a line, its middle included
            c[k] += i % 3 == 1 ? 0.0F : step;         // or two corners in one place
        }
        mesh.add(a, b, c);
    }
    const RayGeometry geometry = geometry_of(mesh);
    RayBatch rays = all_rays(geometry, 1000, 60);
    for (std::size_t i = 0; i < 20000; ++i) {
        const auto id = static_cast<std::uint32_t>(1 + i % 300);
        const glm::vec3 a(geometry.corner(id, 0));
        const glm::vec3 b(geometry.corner(id, 1));
        const glm::vec3 target = a + std::round(uniform(0.0F, 4.0F)) * 0.25F * (b - a);
        const glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        rays.add(origin, target - origin);
    }
    for (const Backend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        const std::vector<int> any = queries.any(rays);
        const std::vector<RayHit> hits = queries.closest(rays);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            wrong += hits[i].triangle != NO_TRIANGLE && hits[i].triangle != 0 ? 1 : 0;
            wrong += any[i] == (hits[i].triangle == 0 ? 1 : 0) ? 0 : 1;
        }
        EXPECT_EQ(wrong, 0U) << test::backend_name(backend);
    }
}

}  // namespace
}  // namespace weft
