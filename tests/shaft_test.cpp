// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bvh_meshes.h"
#include "shadow_room.h"
#include "shaft_cases.h"

// Shafts between boxes: what is called open is open, by brute force in double precision; what is
// plainly open is called so; and every backend calls the same ones open.
namespace weft {
namespace {

using test::Backend;
using test::RayGeometry;
using test::Region;
using test::ShaftRecord;
using test::Uniform;

RayGeometry geometry_of_mesh(const test::BvhMesh& mesh, float scale, float shift) {
    RayGeometry geometry{mesh.positions, mesh.triangles};
    for (shared::float4& p : geometry.positions)
        p = {scale * p.x + shift, scale * p.y - shift, scale * p.z, 0.0F};
    return geometry;
}

struct NamedGeometry {
    std::string name;
    RayGeometry geometry;
};

std::vector<NamedGeometry> geometries() {
    return {
        {"few triangles", geometry_of_mesh(test::random_soup(12, 0.3F, 51), 1.0F, 0.0F)},
        {"soup", geometry_of_mesh(test::random_soup(150, 0.08F, 52), 1.0F, 0.0F)},
        {"small and far away", geometry_of_mesh(test::random_soup(60, 0.1F, 53), 0.01F, 30.0F)},
        {"large", geometry_of_mesh(test::random_soup(60, 0.1F, 54), 1e4F, 2e3F)},
        {"needles", geometry_of_mesh(test::diagonal_needles(40, 55), 1.0F, 0.0F)},
        {"grid", geometry_of_mesh(test::flat_grid(8), 1.0F, 0.0F)},
    };
}

TEST(Shaft, WhatIsOpenLetsEverySegmentThrough) {
    std::size_t total = 0;
    for (const NamedGeometry& named : geometries()) {
        const test::ShaftCases cases = test::random_shafts(named.geometry, 1500, 61);
        const std::vector<std::uint32_t> open = test::query_shafts(
            test::shared_executor(Backend::own_bvh), named.geometry, cases.records);
        std::size_t proven = 0;
        std::size_t blocked = 0;
        Uniform uniform(62);
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (open[i] == 0) continue;
            ++proven;
            blocked += test::blocked_segments(named.geometry, cases, i, 256, uniform);
        }
        EXPECT_EQ(blocked, 0U) << named.name;
        EXPECT_GT(proven, open.size() / 20) << named.name;
        EXPECT_LT(proven, open.size()) << named.name;
        std::cout << named.name << ": " << proven << " of " << open.size() << " open\n";
        total += proven;
    }
    EXPECT_GT(total, 2000U);
}

TEST(Shaft, TheJudgeOfSegmentsSeesWhatBlocks) {
    // The same count over all shafts, open or not: were it blind, the test above could not fail.
    const RayGeometry geometry = geometry_of_mesh(test::random_soup(150, 0.08F, 52), 1.0F, 0.0F);
    const test::ShaftCases cases = test::random_shafts(geometry, 100, 61);
    Uniform uniform(62);
    std::size_t blocked = 0;
    for (std::size_t i = 0; i < cases.records.size(); ++i)
        blocked += test::blocked_segments(geometry, cases, i, 64, uniform);
    EXPECT_GT(blocked, 200U);
}

TEST(Shaft, EveryBackendAndWidthGivesTheSameAnswers) {
    std::vector<test::ShaftCases> cases;
    std::vector<std::vector<std::uint32_t>> expected;
    const std::vector<NamedGeometry> all = geometries();
    for (const NamedGeometry& named : all) {
        cases.push_back(test::random_shafts(named.geometry, 1500, 63));
        expected.push_back(test::query_shafts(test::shared_executor(Backend::own_bvh),
                                              named.geometry, cases.back().records));
    }
    for (const Backend backend : test::backends())
        for (const std::uint32_t lanes : {1U, 4U, 8U, 16U}) {
            const auto executor = test::make_executor(backend, lanes);
            for (std::size_t i = 0; i < all.size(); ++i)
                EXPECT_EQ(test::query_shafts(*executor, all[i].geometry, cases[i].records),
                          expected[i])
                    << test::backend_name(backend) << ", " << lanes << " lanes, " << all[i].name;
        }
}

TEST(Shaft, MostUnshadowedFloorIsProvenOpen) {
    constexpr int tiles = 32;
    for (const double angle : {0.0, 0.5}) {
        const test::ShadowRoom room(angle);
        std::vector<ShaftRecord> records;
        std::vector<bool> shadowed;
        for (int z = 0; z < tiles; ++z)
            for (int x = 0; x < tiles; ++x) {
                const auto [low, high] = test::ShadowRoom::tile(x, z, tiles);
                records.push_back(room.record(low, high));
                shadowed.push_back(room.shadowed(low, high));
            }
        for (const Backend backend : test::backends()) {
            const std::vector<std::uint32_t> open =
                test::query_shafts(test::shared_executor(backend), room.geometry, records);
            std::size_t clear = 0;
            std::size_t proven = 0;
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < records.size(); ++i) {
                clear += shadowed[i] ? 0 : 1;
                proven += !shadowed[i] && open[i] == 1 ? 1 : 0;
                wrong += shadowed[i] && open[i] == 1 ? 1 : 0;
            }
            EXPECT_EQ(wrong, 0U) << test::backend_name(backend);
            EXPECT_GE(proven * 100, clear * 95) << test::backend_name(backend);
            EXPECT_GT(clear, records.size() / 3);
            EXPECT_LT(clear, records.size());
            std::cout << test::backend_name(backend) << ", block turned by " << angle << ": "
                      << proven << " of " << clear << " unshadowed tiles are proven\n";
        }
    }
}

/// Answers of own BVH, after a check that all backends agree.
std::vector<std::uint32_t> answers(const RayGeometry& geometry,
                                   const std::vector<ShaftRecord>& records) {
    const std::vector<std::uint32_t> expected =
        test::query_shafts(test::shared_executor(Backend::own_bvh), geometry, records);
    for (const Backend backend : test::backends())
        EXPECT_EQ(test::query_shafts(test::shared_executor(backend), geometry, records), expected)
            << test::backend_name(backend);
    return expected;
}

TEST(Shaft, PlanesOfReceiversAndLightAreNeeded) {
    const test::ShadowRoom room(0.0);
    const auto [low, high] = test::ShadowRoom::tile(0, 0, 8);
    const ShaftRecord both = room.record(low, high);
    ShaftRecord no_receiver = both;
    no_receiver.receiver_plane = {};
    ShaftRecord no_light = both;
    no_light.light_plane = {};
    // A plane below the floor does not hide it, but for rounding.
    ShaftRecord lower = both;
    lower.receiver_plane.w -= 2e-6F;
    ShaftRecord rounded = both;
    rounded.receiver_plane.w -= 5e-7F;
    const std::vector<std::uint32_t> expected{1, 0, 0, 0, 1};
    EXPECT_EQ(answers(room.geometry, {both, no_receiver, no_light, lower, rounded}), expected);
}

TEST(Shaft, FlatBoxesAndPointsAreBoxes) {
    // One triangle in x = 0.5 that covers y, z in [0, 1] but for a corner.
    RayGeometry geometry;
    geometry.positions = {
        {0.5F, 0.0F, 0.0F, 0.0F}, {0.5F, 1.0F, 0.0F, 0.0F}, {0.5F, 0.0F, 1.0F, 0.0F}};
    geometry.triangles = {{0, 1, 2, 0}};
    const auto points = [](float ay, float az, float by, float bz) {
        const shared::float4 a{0.0F, ay, az, 0.0F};
        const shared::float4 b{1.0F, by, bz, 0.0F};
        return ShaftRecord{a, a, b, b, {}, {}};
    };
    ShaftRecord line = points(0.8F, 0.8F, 0.8F, 0.8F);  // beside the slanted edge
    line.b_high.y = 0.9F;
    ShaftRecord flat = line;
    flat.a_high.z = 0.9F;
    ShaftRecord wide = line;
    wide.a_low.y = -0.8F;
    ShaftRecord away = line;  // both boxes on one side of the triangle
    away.b_low.x = away.b_high.x = 0.4F;
    away.a_low.y = -0.8F;
    ShaftRecord same = points(0.2F, 0.2F, 0.2F, 0.2F);
    same.b_low.x = same.b_high.x = 0.0F;
    const std::vector<std::uint32_t> expected{0, 1, 1, 1, 0, 1, 1};
    EXPECT_EQ(answers(geometry, {points(0.2F, 0.2F, 0.3F, 0.3F), points(-0.2F, 0.2F, -0.3F, 0.3F),
                                 line, flat, wide, away, same}),
              expected);
}

TEST(Shaft, WhatItTouchesCloses) {
    // From a square to one twice as large. Triangles that come near, by a tip: both ends, a slanted
    // side along and across its slope, and a slanted edge.
    const ShaftRecord record{{-1.0F, -1.0F, -1.0F, 0.0F},
                             {-1.0F, 1.0F, 1.0F, 0.0F},
                             {1.0F, -2.0F, -2.0F, 0.0F},
                             {1.0F, 2.0F, 2.0F, 0.0F},
                             {},
                             {}};
    struct Near {
        glm::vec3 point;  // where the triangle comes nearest, at distance 0
        glm::vec3 outward;
        glm::vec3 along;  // one direction of the triangle; the other is outward
    };
    const std::vector<Near> all{
        {{-1.0F, 0.5F, 0.0F}, {-1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}},
        {{1.0F, 1.5F, 0.3F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}},
        {{0.0F, 1.5F, 0.3F}, {-0.5F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}},
        {{0.0F, 1.5F, 0.3F}, {-0.5F, 1.0F, 0.0F}, {1.0F, 0.5F, 0.0F}},
        {{0.0F, 1.5F, -1.5F}, {-1.0F, 1.0F, -1.0F}, {0.0F, 1.0F, 1.0F}},
    };
    for (const Near& near : all)
        for (const float distance : {-1e-3F, 0.0F, 1e-6F, 1e-3F}) {
            const glm::vec3 tip = near.point + distance * near.outward;
            const glm::vec3 left = tip + 0.3F * near.outward + 0.2F * near.along;
            const glm::vec3 right = tip + 0.3F * near.outward - 0.2F * near.along;
            RayGeometry geometry;
            for (const glm::vec3& p : {tip, left, right})
                geometry.positions.push_back({p.x, p.y, p.z, 0.0F});
            geometry.triangles = {{0, 1, 2, 0}};
            EXPECT_EQ(answers(geometry, {record}),
                      std::vector<std::uint32_t>{distance > 1e-4F ? 1U : 0U})
                << distance << " from " << near.point.x << " " << near.point.y << " "
                << near.point.z;
        }
}

/// A slanted strip of `steps` rectangles that goes by an edge of the box [0, 1]^2 x [0, 4] at a
/// small distance, so that boxes about parts of it reach into that box.
RayGeometry strip_along_an_edge(std::uint32_t steps) {
    RayGeometry geometry;
    const float step = 4.0F / static_cast<float>(steps);
    for (std::uint32_t i = 0; i <= steps; ++i)
        for (const float side : {-0.01F, 0.013F})
            geometry.positions.push_back(
                {1.0001F + side, 1.0001F - side, step * static_cast<float>(i), 0.0F});
    for (std::uint32_t v = 0; v < 2 * steps; v += 2) {
        geometry.triangles.push_back({v, v + 1, v + 3, 0});
        geometry.triangles.push_back({v, v + 3, v + 2, 0});
    }
    return geometry;
}

TEST(Shaft, GivesUpWhereTheProofIsLong) {
    const ShaftRecord record{{0.0F, 0.0F, 0.0F, 0.0F},
                             {1.0F, 1.0F, 0.0F, 0.0F},
                             {0.0F, 0.0F, 4.0F, 0.0F},
                             {1.0F, 1.0F, 4.0F, 0.0F},
                             {},
                             {}};
    EXPECT_EQ(answers(strip_along_an_edge(100), {record}), std::vector<std::uint32_t>{1});
    EXPECT_EQ(answers(strip_along_an_edge(12000), {record}), std::vector<std::uint32_t>{0});
}

TEST(Shaft, WhatIsNoShaftIsNotProven) {
    const test::ShadowRoom room(0.0);
    const auto [low, high] = test::ShadowRoom::tile(0, 0, 8);
    const ShaftRecord good = room.record(low, high);
    std::vector<ShaftRecord> records;
    for (const float odd :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          -std::numeric_limits<float>::infinity()})
        for (std::size_t value = 0; value < 24; ++value) {
            if (value < 16 && value % 4 == 3) continue;  // not read
            ShaftRecord record = good;
            float* const values = &record.a_low.x;
            values[value] = odd;
            records.push_back(record);
        }
    ShaftRecord turned = good;
    std::swap(turned.a_low, turned.a_high);
    ShaftRecord long_normal = good;
    long_normal.receiver_plane.y = 1.1F;
    ShaftRecord overlapping = good;
    overlapping.a_low = {-0.9F, 0.2F, -0.9F, 0.0F};
    overlapping.a_high = {-0.5F, 0.4F, -0.5F, 0.0F};
    overlapping.b_low = {-0.6F, 0.3F, -0.6F, 0.0F};
    overlapping.b_high = {-0.4F, 0.5F, -0.5F, 0.0F};
    ShaftRecord huge = good;
    huge.b_high.x = 3e38F;
    records.insert(records.end(), {turned, long_normal, overlapping, huge});
    EXPECT_EQ(answers(room.geometry, {good}), std::vector<std::uint32_t>{1});
    EXPECT_EQ(answers(room.geometry, records), std::vector<std::uint32_t>(records.size(), 0));
}

TEST(Shaft, ASceneWithoutTrianglesIsOpen) {
    const test::ShadowRoom room(0.0);
    const auto [low, high] = test::ShadowRoom::tile(0, 0, 8);
    EXPECT_EQ(answers({}, {room.record(low, high)}), std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace weft
