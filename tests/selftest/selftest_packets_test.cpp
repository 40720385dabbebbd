// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>

#include "selftest/hard_rays.h"
#include "selftest/ray_packets.h"

// The packets of rays that `weft selftest` makes: what kernels ask of them, and that they are as
// hard as rays alone.
namespace weft::selftest_packets_test {
namespace {

using selftest::BvhMesh;
using selftest::RayBatch;
using selftest::RayGeometry;

bool same(const shared::float4& a, const shared::float4& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

void expect_blocks(const RayBatch& packets) {
    ASSERT_EQ(packets.size() % PACKET_BLOCK, 0U);
    for (std::size_t i = 0; i < packets.size(); ++i) {
        EXPECT_TRUE(same(packets.origins[i], packets.origins[i - i % PACKET_BLOCK])) << i;
        EXPECT_EQ(packets.origins[i].w, selftest::ray_infinity) << i;
        EXPECT_NE(packets.direction(i), glm::dvec3(0.0)) << i;
    }
}

TEST(SelftestPackets, KeepDirectionsAndTargetsOfRaysOfOneKind) {
    RayBatch rays;
    for (std::size_t i = 0; i < 500; ++i) {
        const auto x = static_cast<float>(i);
        rays.add({x, 2.0F, 3.0F}, {static_cast<float>(i % 12), 1.0F, 0.0F}, 4.0F);
    }
    const RayBatch packets = selftest::in_packets(rays);
    // Two groups of 12 blocks fit into 500 rays; each of their rays is there twice.
    ASSERT_EQ(packets.size(), 2U * 2U * 12U * PACKET_BLOCK);
    expect_blocks(packets);
    for (std::size_t block = 0; block < packets.size(); block += 2 * PACKET_BLOCK)
        for (std::size_t k = 0; k < PACKET_BLOCK; ++k) {
            const glm::dvec3 first = packets.origin(block);
            const glm::dvec3 own = packets.direction(block + k);
            EXPECT_EQ(own, packets.direction(block)) << "rays of one kind";
            const glm::dvec3 target(first.x + 12.0 * static_cast<double>(k) + own.x, 3.0, 3.0);
            EXPECT_EQ(first + packets.direction(block + PACKET_BLOCK + k), target);
        }
}

TEST(SelftestPackets, OfHardRaysHoldZerosAndDenormals) {
    const BvhMesh soup = selftest::random_soup(50, 0.3F, 3);
    const RayGeometry geometry{soup.positions, soup.triangles};
    const RayBatch packets = selftest::in_packets(selftest::all_rays(geometry, 384, 1));
    EXPECT_EQ(packets.size(), 2U * 3U * 384U);
    expect_blocks(packets);
    std::size_t tiny = 0;
    std::size_t zero = 0;
    for (const shared::float4& d : packets.directions) {
        tiny += d.x != 0.0F && std::abs(d.x) < 1e-18F ? 1 : 0;
        zero += d.x == 0.0F ? 1 : 0;
    }
    EXPECT_GT(tiny, packets.size() / 50);
    EXPECT_GT(zero, packets.size() / 50);
}

TEST(SelftestPackets, FromInsideOfARoomLeadOutOfIt) {
    for (const selftest::ClosedMesh& mesh : selftest::closed_meshes()) {
        const selftest::Room room = selftest::place(mesh.mesh, selftest::placements()[1]);
        const RayBatch packets = selftest::packets_inside(room, 20, 7);
        ASSERT_EQ(packets.size(), 20U * PACKET_BLOCK);
        expect_blocks(packets);
        // All of a mesh lies within the farthest of its corners.
        double farthest = 0.0;
        for (std::uint32_t i = 0; i < room.geometry.triangles.size(); ++i)
            farthest = std::max(farthest, glm::distance(room.geometry.corner(i, 0), room.centre));
        for (std::size_t i = 0; i < packets.size(); ++i) {
            EXPECT_LT(glm::distance(packets.origin(i), room.centre), room.radius);
            EXPECT_GT(glm::distance(packets.origin(i) + packets.direction(i), room.centre),
                      1.2 * farthest)
                << mesh.name;
        }
        const selftest::PacketBatch shadows = selftest::shadow_packets(packets);
        EXPECT_EQ(shadows.origins.size(), 20U);
        ASSERT_EQ(shadows.slots(), packets.size());
        EXPECT_EQ(shadows.planes[1][33], packets.directions[33].y);
        EXPECT_EQ(shadows.planes[3][33], 1.0F);
    }
}

}  // namespace
}  // namespace weft::selftest_packets_test
