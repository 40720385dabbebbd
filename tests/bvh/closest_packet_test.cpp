// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/testing/ray_fans.h"

// Closest hits in packets are those of single rays, bit for bit, whatever the width, the company
// and the backend.
namespace weft::closest_packet_test {
namespace {

using test::Fan;
using test::RayBatch;
using test::RayHit;
using test::TestBackend;

/// The fans' rays, each beside others of its fan; every `left_out`th is not to be traced (0: all
/// are).
RayBatch rays_of(const std::vector<Fan>& all, std::size_t left_out) {
    RayBatch rays;
    for (const Fan& fan : all)
        for (std::size_t i = 0; i < fan.ends.size(); ++i) {
            const bool traced = left_out == 0 || i % left_out != 0;
            rays.add(fan.origin, fan.ends[i], traced ? test::ray_infinity : 0.0F);
        }
    return rays;
}

std::size_t hit_count(const std::vector<RayHit>& hits) {
    std::size_t count = 0;
    for (const RayHit& hit : hits) count += hit.triangle != INVALID_INDEX ? 1 : 0;
    return count;
}

void expect_hits_of_single_rays(const test::RayGeometry& geometry, const RayBatch& rays) {
    constexpr std::array<std::uint32_t, 4> widths{1, 4, 8, 16};
    for (const TestBackend backend : test::backends())
        for (const std::uint32_t lanes : widths) {
            const auto executor = test::make_executor(backend, lanes);
            const test::RayQueries queries(*executor, geometry);
            const std::vector<RayHit> expected = queries.closest(rays);
            const std::vector<RayHit> found = queries.closest_packets(rays);
            std::size_t different = 0;
            for (std::size_t i = 0; i < expected.size(); ++i)
                different += found[i] == expected[i] ? 0 : 1;
            EXPECT_EQ(different, 0U) << test::backend_name(backend) << ", " << lanes << " lanes";
            EXPECT_GT(hit_count(expected), rays.size() / 10);
        }
}

TEST(ClosestPacket, FindsWhatSingleRaysFind) {
    expect_hits_of_single_rays(test::soup(), rays_of(test::fans(200, 41), 0));
}

TEST(ClosestPacket, NoLaneDependsOnThoseLeftOut) {
    expect_hits_of_single_rays(test::soup(), rays_of(test::fans(200, 42), 3));
}

TEST(ClosestPacket, TheSmallestOfCoincidentTrianglesWins) {
    // Every triangle three times: packets must choose by id, not by the order of their tree.
    test::RayGeometry geometry = test::soup();
    const std::vector<shared::Triangle> once = geometry.triangles;
    for (int copy = 0; copy < 2; ++copy)
        geometry.triangles.insert(geometry.triangles.end(), once.begin(), once.end());
    const RayBatch rays = rays_of(test::fans(100, 43), 0);
    expect_hits_of_single_rays(geometry, rays);
    const test::RayQueries queries(test::shared_executor(TestBackend::own_bvh), geometry);
    for (const RayHit& hit : queries.closest_packets(rays)) {
        if (hit.triangle != INVALID_INDEX) {
            EXPECT_LT(hit.triangle, once.size());
        }
    }
}

}  // namespace
}  // namespace weft::closest_packet_test
