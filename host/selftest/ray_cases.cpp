// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "selftest/case_groups.h"
#include "selftest/hard_rays.h"
#include "selftest/ray_brute_force.h"
#include "selftest/ray_oracle.h"
#include "selftest/ray_packets.h"
#include "selftest/watertight.h"

// Intersections of rays and triangles, by the kernels that answer ray queries.
namespace weft::selftest {
namespace {

constexpr std::size_t inside_rays = 4000;  // of each mesh at each place
constexpr std::size_t inside_blocks = 64;  // likewise, of PACKET_BLOCK rays each
constexpr std::size_t packet_rays = 768;   // of each kind: blocks of 16 of each of twelve kinds

/// Runs `test` in each of the five closed meshes at the first three places of five: in place, far
/// away, and small.
template <class Test>
void in_closed_meshes(const Test& test) {
    std::uint32_t seed = 100;
    for (const ClosedMesh& mesh : closed_meshes()) {
        const std::vector<Placement> everywhere = placements();
        for (std::size_t i = 0; i < 3; ++i)
            test(mesh, place(mesh.mesh, everywhere[i]), seed += 1000);
    }
}

/// Number of answers of either kind of query that let a ray out of a closed mesh, or that report a
/// hit in the wrong place.
double leaking_rays(Executor& executor) {
    double leaks = 0.0;
    in_closed_meshes([&](const ClosedMesh& mesh, const Room& room, std::uint32_t seed) {
        const Leaks found = leaks_of(executor, mesh, room, inside_rays, seed);
        leaks += static_cast<double>(found.closest + found.any + found.apart);
    });
    return leaks;
}

/// The same of rays in packets: by closest hits, and by shadow rays that end outside.
std::vector<Measured> leaking_packets(Executor& executor) {
    Leaks found;
    in_closed_meshes([&](const ClosedMesh& mesh, const Room& room, std::uint32_t seed) {
        const RayQueries queries(executor, room.geometry);
        const RayBatch rays = packets_inside(room, inside_blocks, seed + 500);
        count_leaks(mesh, room, rays, queries.closest_packets(rays),
                    blocked_in_packets(queries, rays), found);
    });
    return {static_cast<double>(found.closest + found.apart), static_cast<double>(found.any)};
}

SelftestCase watertight_meshes() {
    const std::string opposites = "edge functions of neighbouring triangles are exact opposites";
    SelftestCase made{16,
                      "closed meshes, rays at vertices and edges",
                      RunsOn::devices,
                      {{"wrong answers of 60000 rays", 0.0, within(0.0), opposites},
                       {"in packets, of 15360 rays", 0.0, within(0.0), opposites},
                       {"shadow packets, of 15360 rays", 0.0, within(0.0),
                        "what is outside by less than rounding counts as inside"}},
                      [](Executor& executor) -> std::vector<Measured> {
                          const std::vector<Measured> packets = leaking_packets(executor);
                          return {leaking_rays(executor), packets[0], packets[1]};
                      }};
    for (Check& check : made.checks) check.own_traversal = true;
    return made;
}

RayGeometry geometry_of(const BvhMesh& mesh) {
    return {mesh.positions, mesh.triangles};
}

/// Number of answers that contradict those which are certain in double precision.
double against_oracle(Executor& executor, const RayGeometry& geometry, const RayBatch& rays) {
    const RayQueries queries(executor, geometry);
    return static_cast<double>(
        compare_with_oracle(geometry, rays, queries.closest(rays), queries.any(rays)).wrong);
}

/// The same for closest hits in packets. Rays are infinite, so every one that hits is blocked.
double packets_against_oracle(Executor& executor, const RayGeometry& geometry,
                              const RayBatch& packets) {
    const std::vector<RayHit> hits = RayQueries(executor, geometry).closest_packets(packets);
    std::vector<int> any;
    for (const RayHit& hit : hits) any.push_back(hit.triangle != INVALID_INDEX ? 1 : 0);
    return static_cast<double>(compare_with_oracle(geometry, packets, hits, any).wrong);
}

/// Numbers of hits of triangles without area, by single rays and in packets.
std::vector<Measured> hits_without_area(Executor& executor) {
    const RayGeometry geometry = geometry_of(triangles_without_area());
    RayBatch rays;
    add_rays_at_flat_triangles(rays, geometry, 4000, 91);
    const RayQueries queries(executor, geometry);
    const auto wrong = [](const std::vector<RayHit>& hits) {
        return static_cast<double>(std::ranges::count_if(hits, [](const RayHit& hit) {
            return hit.triangle != INVALID_INDEX && hit.triangle != 0;
        }));
    };
    return {wrong(queries.closest(rays)), wrong(queries.closest_packets(in_packets(rays)))};
}

/// Number of hits that are not finite, or of triangles off the ray's line. Where products of three
/// lengths underflow, distances lose all precision, but there must be no false hit.
double false_hits(const RayGeometry& geometry, const RayBatch& rays,
                  const std::vector<RayHit>& hits) {
    double wrong = 0.0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const RayHit& hit = hits[i];
        if (hit.triangle == INVALID_INDEX) continue;
        const Verdict verdict =
            judge(rays.origin(i), rays.direction(i), INFINITY, geometry, hit.triangle);
        const bool finite = std::isfinite(hit.t) && std::isfinite(hit.u) && std::isfinite(hit.v);
        wrong += finite && verdict.inside > -1e-4 ? 0.0 : 1.0;
    }
    return wrong;
}

RayBatch needle_rays(const RayGeometry& geometry, std::size_t count) {
    RayBatch rays = all_rays(geometry, count, 40);
    add_rays_in_planes(rays, count, 61);
    return rays;
}

std::vector<Measured> measure_degenerate(Executor& executor) {
    const RayGeometry needles = geometry_of(thin_needles());
    const RayGeometry huge = huge_and_tiny(1.0F);
    const RayBatch at_huge = rays_huge_and_tiny(1.0F);
    const RayGeometry tiniest = huge_and_tiny(1e-6F);
    const RayBatch at_tiniest = rays_huge_and_tiny(1e-6F);
    const RayBatch tiniest_packets = in_packets(at_tiniest);
    const RayQueries queries(executor, tiniest);
    const std::vector<Measured> flat = hits_without_area(executor);
    return {
        against_oracle(executor, needles, needle_rays(needles, 700)),
        packets_against_oracle(executor, needles, in_packets(needle_rays(needles, packet_rays))),
        against_oracle(executor, huge, at_huge),
        packets_against_oracle(executor, huge, in_packets(at_huge)),
        false_hits(tiniest, at_tiniest, queries.closest(at_tiniest)),
        false_hits(tiniest, tiniest_packets, queries.closest_packets(tiniest_packets)),
        flat[0],
        flat[1]};
}

SelftestCase degenerate_triangles() {
    const std::string exact = "where no rounding can change an answer there is one right answer";
    const std::string on_line = "a hit is finite and of a triangle on the ray's line";
    const std::string left_out = "they are left out";
    // Embree's own arithmetic reports some false hits right at ray origins: up to one of 300.
    return {17,
            "degenerate triangles",
            RunsOn::devices,
            {{"wrong answers, needles of 1e-20", 0.0, within(0.0), exact, within(9.0)},
             {"wrong answers in packets, needles of 1e-20", 0.0, within(0.0), exact, within(20.0)},
             {"wrong answers, 1e9 beside 1", 0.0, within(0.0), exact, within(18.0)},
             {"wrong answers in packets, 1e9 beside 1", 0.0, within(0.0), exact, within(36.0)},
             {"false hits, 1e9 beside 1e-6", 0.0, within(0.0), on_line},
             {"false hits in packets, 1e9 beside 1e-6", 0.0, within(0.0), on_line},
             {"hits of triangles without area", 0.0, within(0.0), left_out},
             {"hits in packets of triangles without area", 0.0, within(0.0), left_out}},
            measure_degenerate};
}

/// Number of hits that differ in any bit from those of a test of all triangles.
double differing_hits(const RayGeometry& geometry, const RayBatch& rays,
                      const std::vector<RayHit>& hits) {
    const std::vector<RayHit> all = test_all(geometry, rays);
    double different = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i) different += hits[i] == all[i] ? 0.0 : 1.0;
    return different;
}

/// The same for single rays and for rays in packets.
std::vector<Measured> unlike_brute_force(Executor& executor, const RayGeometry& geometry,
                                         std::uint32_t seed) {
    const RayQueries queries(executor, geometry);
    const RayBatch rays = all_rays(geometry, 1000, seed);
    const RayBatch packets = in_packets(all_rays(geometry, packet_rays, seed + 100));
    return {differing_hits(geometry, rays, queries.closest(rays)),
            differing_hits(geometry, packets, queries.closest_packets(packets))};
}

/// Number of answers to shadow rays in packets that contradict those which are certain in double
/// precision. Rays from corners of boxes are left out: packets count as inside what is outside of a
/// triangle by less than some millionths of its farthest corner's distance, which is not small near
/// its nearest corner.
double wrong_shadows(Executor& executor, const RayGeometry& geometry) {
    RayBatch rays = all_rays(geometry, packet_rays, 210);
    rays.origins.resize(2 * packet_rays);
    rays.directions.resize(2 * packet_rays);
    const RayBatch packets = in_packets(rays);
    const std::vector<int> blocked = blocked_in_packets(RayQueries(executor, geometry), packets);
    double wrong = 0.0;
    for (std::size_t i = 0; i < packets.size(); ++i) {
        const ClosestVerdict v = judge_closest(geometry, packets.origin(i), packets.direction(i),
                                               static_cast<double>(SHADOW_END));
        const bool certain = v.must_hit_any || !v.may_hit_any;
        wrong += certain && (blocked[i] == 1) != v.must_hit_any ? 1.0 : 0.0;
    }
    return wrong;
}

SelftestCase axis_rays() {
    const std::string bits =
        "the tree leaves out what a ray misses, and does no arithmetic of hits";
    const std::string exact = "where no rounding can change an answer there is one right answer";
    SelftestCase made{
        18,
        "rays along axes and in planes of boxes",
        RunsOn::devices,
        {{"bits unlike brute force, a soup", 0.0, within(0.0), bits},
         {"packets unlike brute force, a soup", 0.0, within(0.0), bits},
         {"bits unlike brute force, a grid", 0.0, within(0.0), bits},
         {"packets unlike brute force, a grid", 0.0, within(0.0), bits},
         {"wrong answers, a soup", 0.0, within(0.0), exact, within(9.0)},
         {"wrong shadow packets, a soup", 0.0, within(0.0), exact, within(9.0)}},
        [](Executor& executor) -> std::vector<Measured> {
            const RayGeometry soup = geometry_of(random_soup(400, 0.3F, 3));
            const RayGeometry grid = geometry_of(flat_grid(12));
            const std::vector<Measured> of_soup = unlike_brute_force(executor, soup, 10);
            const std::vector<Measured> of_grid = unlike_brute_force(executor, grid, 20);
            return {of_soup[0],
                    of_soup[1],
                    of_grid[0],
                    of_grid[1],
                    against_oracle(executor, soup, all_rays(soup, 1000, 10)),
                    wrong_shadows(executor, soup)};
        }};
    for (std::size_t i = 0; i < 4; ++i) made.checks[i].own_traversal = true;
    return made;
}

}  // namespace

std::vector<SelftestCase> ray_cases() {
    return {watertight_meshes(), degenerate_triangles(), axis_rays()};
}

}  // namespace weft::selftest
