// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/moving_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "bvh/flatten.h"
#include "tests/testing/moving_mesh.h"

// A BVH of a resting and a moving part holds every invariant of one built at once, and is the same
// wherever the moving triangles have been before.
namespace weft::moving_bvh_test {
namespace {

using test::BvhMesh;
using test::MovingMesh;
using test::Pose;
using test::poses;

template <class T>
bool same_bytes(const LargeVector<T>& a, const LargeVector<T>& b, std::size_t from = 0,
                std::size_t end = SIZE_MAX) {
    end = std::min(end, std::max(a.size(), b.size()));
    if (std::min(a.size(), b.size()) < end) return false;
    return from >= end || std::memcmp(&a[from], &b[from], (end - from) * sizeof(T)) == 0;
}

bool same_tree(const WideBvh& a, const WideBvh& b) {
    return same_bytes(a.nodes, b.nodes) && same_bytes(a.leaves, b.leaves) && a.depth == b.depth &&
           a.stack_need == b.stack_need && a.has_spatial_splits == b.has_spatial_splits &&
           a.sah_cost == b.sah_cost;
}

void expect_sound(const MovingBvh& moving, const BvhMesh& mesh, const BvhSettings& settings) {
    const WideBvh& bvh = moving.bvh();
    EXPECT_EQ(check_bvh(bvh, mesh.positions, mesh.triangles, settings), "");
    EXPECT_LE(bvh.stack_need, std::uint32_t{BVH_STACK});
    EXPECT_NEAR(bvh.sah_cost, sah_cost(bvh), 1e-9 * bvh.sah_cost);
    EXPECT_GT(bvh.build_ms, 0.0);
}

MovingBvh build(const MovingMesh& mesh, const BvhSettings& settings = {}) {
    return {mesh.mesh.positions, mesh.mesh.triangles, mesh.first_moving, settings};
}

// Through all poses: it is sound, and what it would be had the triangles never been elsewhere.
void expect_sound_in_all_poses(MovingMesh mesh, const BvhSettings& settings) {
    MovingBvh moving = build(mesh, settings);
    expect_sound(moving, mesh.mesh, settings);
    for (const Pose& pose : poses) {
        mesh.pose(pose);
        const WideBvh before = moving.bvh();
        EXPECT_FALSE(moving.update(mesh.mesh.positions, mesh.mesh.triangles, settings.padding));
        expect_sound(moving, mesh.mesh, settings);
        EXPECT_TRUE(same_tree(moving.bvh(), build(mesh, settings).bvh()));
        EXPECT_TRUE(same_bytes(before.nodes, moving.bvh().nodes, 1, moving.resting_nodes()));
        EXPECT_TRUE(same_bytes(before.leaves, moving.bvh().leaves, 0, moving.resting_floats()));
    }
}

TEST(MovingBvh, EveryPoseHoldsEveryInvariant) {
    struct Count {
        std::size_t resting, moving;
    };
    for (const Count& count : std::array<Count, 8>{
             {{0, 1}, {1, 0}, {1, 1}, {0, 300}, {300, 0}, {300, 1}, {1, 300}, {2000, 500}}})
        for (const std::uint32_t max_leaf : {1U, 4U, 8U}) {
            const float padding = max_leaf == 4 ? 0.01F : 0.0F;
            SCOPED_TRACE(std::to_string(count.resting) + " and " + std::to_string(count.moving) +
                         " triangles in leaves of " + std::to_string(max_leaf));
            expect_sound_in_all_poses(test::moving_soup(count.resting, count.moving, 51),
                                      {.max_leaf_triangles = max_leaf, .padding = padding});
        }
}

TEST(MovingBvh, TheRestingPartIsSplitWhereThatPays) {
    const MovingMesh mesh = test::needles_and_moving_soup(2000, 300, 52);
    expect_sound_in_all_poses(mesh, {});
    EXPECT_TRUE(build(mesh).bvh().has_spatial_splits);
    const MovingMesh all_move{mesh.mesh, 0};
    EXPECT_FALSE(build(all_move).bvh().has_spatial_splits);
}

TEST(MovingBvh, WhereSomebodyWaitsItHasNoSplits) {
    MovingMesh mesh = test::needles_and_moving_soup(2000, 300, 52);
    const auto make = [&](std::size_t first_moving) {
        return MovingBvh(mesh.mesh.positions, mesh.mesh.triangles, first_moving, {}, nullptr,
                         BvhEffort::soon);
    };
    MovingBvh moving = make(mesh.first_moving);
    EXPECT_FALSE(moving.bvh().has_spatial_splits);
    expect_sound(moving, mesh.mesh, {});
    mesh.pose(poses[1]);
    EXPECT_TRUE(moving.update(mesh.mesh.positions, mesh.mesh.triangles, 0.01F));
    EXPECT_FALSE(moving.bvh().has_spatial_splits);
    expect_sound(moving, mesh.mesh, {.padding = 0.01F});
    // Where nothing moves the tree is always the same.
    EXPECT_TRUE(make(mesh.mesh.triangles.size()).bvh().has_spatial_splits);
}

TEST(MovingBvh, WhereNothingMovesItIsTheTreeOfBuildBvh) {
    const BvhMesh mesh = test::diagonal_needles(2000, 53);
    const WideBvh expected = build_bvh(mesh.positions, mesh.triangles, {});
    for (const std::size_t first :
         {mesh.triangles.size(), std::numeric_limits<std::size_t>::max()}) {
        MovingBvh bvh(mesh.positions, mesh.triangles, first, {});
        EXPECT_FALSE(bvh.moves());
        EXPECT_TRUE(same_tree(bvh.bvh(), expected));
        EXPECT_FALSE(bvh.update(mesh.positions, mesh.triangles, 0.0F));
        EXPECT_TRUE(same_tree(bvh.bvh(), expected));
        EXPECT_EQ(bvh.resting_nodes(), expected.nodes.size());
        EXPECT_EQ(bvh.resting_floats(), expected.leaves.size());
    }
}

TEST(MovingBvh, NoTrianglesAreARootThatNothingHits) {
    MovingMesh mesh = test::moving_soup(0, 5, 54);
    mesh.pose({.present = 0.0F});
    const MovingBvh bvh = build(mesh);
    ASSERT_EQ(bvh.bvh().nodes.size(), 1U);
    EXPECT_TRUE(bvh.bvh().leaves == empty_leaves());
    EXPECT_EQ(bvh.bvh().stack_need, 1U);
    EXPECT_EQ(bvh.bvh().sah_cost, 0.0);
}

TEST(MovingBvh, AnotherPaddingGrowsEveryBox) {
    MovingMesh mesh = test::needles_and_moving_soup(1000, 200, 55);
    MovingBvh bvh = build(mesh, {.padding = 0.001F});
    for (const float padding : {0.01F, 0.0F}) {
        mesh.pose(poses[1]);
        EXPECT_TRUE(bvh.update(mesh.mesh.positions, mesh.mesh.triangles, padding));
        expect_sound(bvh, mesh.mesh, {.padding = padding});
        EXPECT_TRUE(same_tree(bvh.bvh(), build(mesh, {.padding = padding}).bvh()));
    }
}

TEST(MovingBvh, DeepPartsStayWithinTheStack) {
    // Every triangle holds all smaller ones, which makes surface area splits chip off a few.
    MovingMesh mesh;
    for (int i = 0; i < 8000; ++i) {
        const float size = std::exp2(static_cast<float>(i % 4000) * 0.02F - 40.0F);
        mesh.mesh.add({-size, -size, -size}, {size, -size, size}, {-size, size, size});
    }
    mesh.first_moving = 4000;
    for (const bool splits : {false, true}) {
        const BvhSettings settings{.spatial_splits = splits};
        MovingBvh bvh = build(mesh, settings);
        expect_sound(bvh, mesh.mesh, settings);
        bvh.update(mesh.mesh.positions, mesh.mesh.triangles, 0.0F);
        expect_sound(bvh, mesh.mesh, settings);
    }
}

ExitCode code_of_update(MovingBvh& bvh, const BvhMesh& mesh, float padding = 0.0F) {
    try {
        bvh.update(mesh.positions, mesh.triangles, padding);
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::success;
}

TEST(MovingBvh, AFailedUpdateChangesNothing) {
    const MovingMesh mesh = test::moving_soup(100, 100, 56);
    MovingBvh bvh = build(mesh);
    BvhMesh fewer = mesh.mesh;
    fewer.triangles.pop_back();
    EXPECT_EQ(code_of_update(bvh, fewer), ExitCode::device);
    BvhMesh wrong = mesh.mesh;
    wrong.triangles[150].v1 = static_cast<std::uint32_t>(wrong.positions.size());
    EXPECT_EQ(code_of_update(bvh, wrong), ExitCode::bad_input);
    EXPECT_EQ(code_of_update(bvh, wrong, 0.5F), ExitCode::bad_input);
    EXPECT_EQ(code_of_update(bvh, mesh.mesh, -1.0F), ExitCode::usage);
    EXPECT_TRUE(same_tree(bvh.bvh(), build(mesh).bvh()));
    EXPECT_EQ(code_of_update(bvh, mesh.mesh), ExitCode::success);
}

}  // namespace
}  // namespace weft::moving_bvh_test
