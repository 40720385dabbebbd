// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "selftest/case_groups.h"
#include "selftest/hard_rays.h"
#include "selftest/ray_brute_force.h"
#include "selftest/ray_oracle.h"
#include "selftest/watertight.h"

// Rays and triangles, by the kernels that answer ray queries.
namespace weft::selftest {
namespace {

constexpr std::size_t inside_rays = 4000;  // of each mesh at each place

/// Answers of either kind of query that let a ray out of a closed mesh, or hit what is elsewhere.
Measured leaking_rays(Executor& executor) {
    double leaks = 0.0;
    std::uint32_t seed = 100;
    std::size_t rooms = 0;
    for (const ClosedMesh& mesh : closed_meshes())
        for (const Placement& placement : placements()) {
            // Of the five places the first three: in place, far away, and small.
            if (rooms++ % 5 >= 3) continue;
            seed += 1000;
            const Leaks found =
                leaks_of(executor, mesh, place(mesh.mesh, placement), inside_rays, seed);
            leaks += static_cast<double>(found.closest + found.any + found.apart);
        }
    return leaks;
}

SelftestCase watertight_meshes() {
    Check check{"wrong answers of 60000 rays", 0.0, within(0.0),
                "edge functions of neighbouring triangles are exact opposites"};
    check.own_traversal = true;
    return {16,
            "closed meshes, rays at vertices and edges",
            RunsOn::devices,
            {check},
            [](Executor& executor) -> std::vector<Measured> { return {leaking_rays(executor)}; }};
}

RayGeometry geometry_of(const BvhMesh& mesh) {
    return {mesh.positions, mesh.triangles};
}

/// Answers that contradict what double precision is certain of.
double against_oracle(Executor& executor, const RayGeometry& geometry, const RayBatch& rays) {
    const RayQueries queries(executor, geometry);
    return static_cast<double>(
        compare_with_oracle(geometry, rays, queries.closest(rays), queries.any(rays)).wrong);
}

/// Hits of triangles without area.
double hits_without_area(Executor& executor) {
    const RayGeometry geometry = geometry_of(triangles_without_area());
    RayBatch rays;
    add_rays_at_flat_triangles(rays, geometry, 4000, 91);
    const RayQueries queries(executor, geometry);
    double wrong = 0.0;
    for (const RayHit& hit : queries.closest(rays))
        wrong += hit.triangle != NO_TRIANGLE && hit.triangle != 0 ? 1.0 : 0.0;
    return wrong;
}

/// Hits that are not finite, or of triangles off the ray's line: where products of three lengths
/// underflow, distances have no digits left, but nothing false may be met.
double false_hits(Executor& executor) {
    const RayGeometry geometry = huge_and_tiny(1e-6F);
    const RayBatch rays = rays_huge_and_tiny(1e-6F);
    const RayQueries queries(executor, geometry);
    double wrong = 0.0;
    std::size_t i = 0;
    for (const RayHit& hit : queries.closest(rays)) {
        if (hit.triangle != NO_TRIANGLE) {
            const Verdict verdict =
                judge(rays.origin(i), rays.direction(i), INFINITY, geometry, hit.triangle);
            const bool finite =
                std::isfinite(hit.t) && std::isfinite(hit.u) && std::isfinite(hit.v);
            wrong += finite && verdict.inside > -1e-4 ? 0.0 : 1.0;
        }
        ++i;
    }
    return wrong;
}

SelftestCase degenerate_triangles() {
    const std::string exact = "where no rounding can change an answer there is one right answer";
    const auto needle_rays = [](const RayGeometry& geometry) {
        RayBatch rays = all_rays(geometry, 700, 40);
        add_rays_in_planes(rays, 700, 61);
        return rays;
    };
    // Embree's own arithmetic finds some hits that are none, right at origins: up to one of 300.
    return {17,
            "degenerate triangles",
            RunsOn::devices,
            {{"wrong answers, needles of 1e-20", 0.0, within(0.0), exact, within(9.0)},
             {"wrong answers, 1e9 beside 1", 0.0, within(0.0), exact, within(18.0)},
             {"false hits, 1e9 beside 1e-6", 0.0, within(0.0),
              "a hit is finite and of a triangle on the ray's line"},
             {"hits of triangles without area", 0.0, within(0.0), "they are left out"}},
            [=](Executor& executor) -> std::vector<Measured> {
                const RayGeometry needles = geometry_of(thin_needles());
                return {against_oracle(executor, needles, needle_rays(needles)),
                        against_oracle(executor, huge_and_tiny(1.0F), rays_huge_and_tiny(1.0F)),
                        false_hits(executor), hits_without_area(executor)};
            }};
}

/// Closest hits that differ in any bit from a test of all triangles.
double differing_hits(Executor& executor, const RayGeometry& geometry, const RayBatch& rays) {
    const std::vector<RayHit> all = test_all(geometry, rays);
    const std::vector<RayHit> hits = RayQueries(executor, geometry).closest(rays);
    double different = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i) different += hits[i] == all[i] ? 0.0 : 1.0;
    return different;
}

SelftestCase axis_rays() {
    const std::string bits =
        "the tree leaves out what a ray misses, and does no arithmetic of hits";
    const std::string exact = "where no rounding can change an answer there is one right answer";
    SelftestCase made{18,
                      "rays along axes and in planes of boxes",
                      RunsOn::devices,
                      {{"bits unlike brute force, a soup", 0.0, within(0.0), bits},
                       {"bits unlike brute force, a grid", 0.0, within(0.0), bits},
                       {"wrong answers, a soup", 0.0, within(0.0), exact, within(9.0)}},
                      [](Executor& executor) -> std::vector<Measured> {
                          const RayGeometry soup = geometry_of(random_soup(400, 0.3F, 3));
                          const RayGeometry grid = geometry_of(flat_grid(12));
                          const RayBatch at_soup = all_rays(soup, 1000, 10);
                          return {differing_hits(executor, soup, at_soup),
                                  differing_hits(executor, grid, all_rays(grid, 1000, 20)),
                                  against_oracle(executor, soup, at_soup)};
                      }};
    made.checks[0].own_traversal = made.checks[1].own_traversal = true;
    return made;
}

}  // namespace

std::vector<SelftestCase> ray_cases() {
    return {watertight_meshes(), degenerate_triangles(), axis_rays()};
}

}  // namespace weft::selftest
