// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/wide_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>

#include "base/error.h"
#include "bvh/embree_tree.h"
#include "bvh/flatten.h"
#include "tests/testing/bvh_meshes.h"

namespace weft::wide_bvh_test {
namespace {

using test::BvhMesh;

// Builds, and fails the test where the result breaks an invariant.
WideBvh build(const BvhMesh& mesh, const BvhSettings& settings = {}) {
    WideBvh bvh = build_bvh(mesh.positions, mesh.triangles, settings);
    EXPECT_EQ(check_bvh(bvh, mesh.positions, mesh.triangles, settings), "");
    EXPECT_LE(bvh.stack_need, std::uint32_t{BVH_STACK});
    return bvh;
}

std::vector<std::uint32_t> sorted_ids(const WideBvh& bvh) {
    std::vector<std::uint32_t> ids;
    for (const shared::BvhNode& node : bvh.nodes)
        for (const std::uint32_t child : node.child)
            for (std::uint32_t i = 0; is_leaf(child) && i < leaf_count(child); ++i)
                ids.push_back(leaf_triangle(bvh.leaves, child, i).id);
    std::sort(ids.begin(), ids.end());
    return ids;
}

ExitCode code_of_failure(const BvhMesh& mesh, const BvhSettings& settings) {
    try {
        std::ignore = build_bvh(mesh.positions, mesh.triangles, settings);
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::success;
}

TEST(WideBvh, NoTrianglesGiveARootThatNothingHits) {
    const WideBvh bvh = build({});
    ASSERT_EQ(bvh.nodes.size(), 1U);
    EXPECT_EQ(bvh.depth, 1U);
    EXPECT_EQ(bvh.stack_need, 1U);
    for (std::size_t slot = 0; slot < node_width; ++slot) {
        EXPECT_EQ(bvh.nodes[0].child[slot], BVH_EMPTY);
        EXPECT_EQ(bvh.nodes[0].bounds[0][slot], FLT_MAX);
        EXPECT_EQ(bvh.nodes[0].bounds[5][slot], -FLT_MAX);
    }
}

TEST(WideBvh, FewTriangles) {
    for (const std::size_t count : {1, 2, 3, 5, 8, 9, 17}) {
        for (const std::uint32_t max_leaf : {1U, 2U, 4U, 8U}) {
            const BvhMesh mesh = test::random_soup(count, 0.1F, 7);
            const WideBvh bvh = build(mesh, {.max_leaf_triangles = max_leaf});
            const std::vector<std::uint32_t> ids = sorted_ids(bvh);
            for (std::uint32_t id = 0; id < count; ++id)
                EXPECT_TRUE(std::binary_search(ids.begin(), ids.end(), id));
        }
    }
}

TEST(WideBvh, OneTriangleIsAnInnerRootWithOneLeaf) {
    BvhMesh mesh;
    mesh.add({1, 2, 3}, {4, 2, 3}, {1, 5, 3});
    const WideBvh bvh = build(mesh);
    ASSERT_EQ(bvh.nodes.size(), 1U);
    EXPECT_EQ(bvh.nodes[0].child[0], BVH_LEAF | 1U << BVH_COUNT_SHIFT);
    EXPECT_EQ(bvh.nodes[0].child[1], BVH_EMPTY);
    EXPECT_EQ(bvh.nodes[0].bounds[0][0], std::nextafter(1.0F, 0.0F));
    EXPECT_EQ(bvh.nodes[0].bounds[1][0], std::nextafter(4.0F, 5.0F));
    EXPECT_EQ(bvh.nodes[0].bounds[5][0], std::nextafter(3.0F, 5.0F));
    EXPECT_EQ(bvh.stack_need, 1U);
    EXPECT_DOUBLE_EQ(bvh.sah_cost, 2.0);
}

TEST(WideBvh, PaddingGrowsEveryBox) {
    BvhMesh mesh;
    mesh.add({1, 2, 3}, {4, 2, 3}, {1, 5, 3});
    const WideBvh bvh = build(mesh, {.padding = 0.25F});
    EXPECT_EQ(bvh.nodes[0].bounds[0][0], std::nextafter(0.75F, 0.0F));
    EXPECT_EQ(bvh.nodes[0].bounds[5][0], std::nextafter(3.25F, 5.0F));
    for (const bool splits : {false, true})
        build(test::diagonal_needles(200, 3), {.spatial_splits = splits, .padding = 0.01F});
}

TEST(WideBvh, IdenticalTrianglesBuildInBoundedDepth) {
    for (const std::size_t count : {5, 1000, 100000}) {
        BvhMesh mesh;
        mesh.positions = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 1, 0}};
        mesh.triangles.assign(count, {0, 1, 2, 0});
        const WideBvh bvh = build(mesh);
        EXPECT_EQ(leaf_entries(bvh.leaves), count);
        EXPECT_FALSE(bvh.has_spatial_splits);
        EXPECT_LE(bvh.depth, 22U);
    }
}

TEST(WideBvh, ConcentricTrianglesStayWithinTheStack) {
    // Every triangle holds all smaller ones, which makes surface area splits chip off a few.
    BvhMesh mesh;
    for (int i = 0; i < 4000; ++i) {
        const float size = std::exp2(static_cast<float>(i) * 0.02F - 40.0F);
        mesh.add({-size, -size, -size}, {size, -size, size}, {-size, size, size});
    }
    for (const bool splits : {false, true}) build(mesh, {.spatial_splits = splits});
}

TEST(WideBvh, LeavesOutWhatNoRayCanHit) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    BvhMesh mesh;
    mesh.add({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
    mesh.add({0, 0, 0}, {1, 2, 3}, {2, 4, 6});
    mesh.add({nan, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.add({0, 0, 0}, {inf, 0, 0}, {0, 1, 0});
    mesh.add({0, 0, 0}, {1, 0, 0}, {0, -inf, 0});
    EXPECT_TRUE(build(mesh).leaves == empty_leaves());
    mesh.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.add({0, 0, 0}, {1, 0, 0}, {0.5F, 1e-30F, 0});
    EXPECT_EQ(sorted_ids(build(mesh)), (std::vector<std::uint32_t>{5, 6}));
}

TEST(WideBvh, HugeAndTinyTrianglesTogether) {
    BvhMesh mesh = test::random_soup(500, 1e-6F, 11);
    mesh.add({-1e15F, 0, 0}, {1e15F, 0, 1e15F}, {0, 1e15F, -1e15F});
    mesh.add({1e-40F, 0, 0}, {0, 1e-40F, 0}, {0, 0, 1e-40F});
    mesh.add({0, 0, 0}, {1, 1, 1}, {0.5F, 0.5F, 0.5000001F});
    for (const bool splits : {false, true}) build(mesh, {.spatial_splits = splits});
}

TEST(WideBvh, CoordinatesTooLargeForEmbreeBuildABalancedTree) {
    BvhMesh mesh = test::random_soup(300, 0.1F, 13);
    mesh.add({-3e38F, 0, 0}, {3e38F, 0, 3e38F}, {0, FLT_MAX, -3e38F});
    EXPECT_EQ(leaf_entries(build(mesh).leaves), 301U);
}

TEST(WideBvh, BalancedTreesHoldEveryInvariant) {
    for (const std::size_t count : {1, 8, 9, 1000, 10000}) {
        const BvhMesh mesh = test::random_soup(count, 0.2F, 17);
        std::vector<Piece> pieces = make_pieces(mesh.positions, mesh.triangles);
        const WideBvh bvh =
            flatten(build_balanced_tree(pieces, 8), mesh.positions, mesh.triangles, {});
        EXPECT_EQ(check_bvh(bvh, mesh.positions, mesh.triangles, {}), "");
        EXPECT_LE(bvh.depth, 6U);
    }
}

TEST(WideBvh, LeavesThatAreTooLargeBecomeSubtrees) {
    const BvhMesh mesh = test::random_soup(300, 0.2F, 19);
    const std::vector<Piece> pieces = make_pieces(mesh.positions, mesh.triangles);
    BuildLeaf leaf;
    leaf.piece_count = static_cast<std::uint32_t>(pieces.size());
    leaf.pieces = pieces.data();
    const WideBvh bvh = flatten({&leaf, nullptr}, mesh.positions, mesh.triangles, {});
    EXPECT_EQ(check_bvh(bvh, mesh.positions, mesh.triangles, {}), "");
    EXPECT_GT(bvh.nodes.size(), 5U);
}

TEST(WideBvh, EmptyLeavesOfATreeAreSkipped) {
    const BvhMesh mesh = test::random_soup(8, 0.2F, 19);
    const std::vector<Piece> pieces = make_pieces(mesh.positions, mesh.triangles);
    BuildLeaf none;
    BuildLeaf all;
    all.piece_count = 8;
    all.pieces = pieces.data();
    BuildInner root;
    root.child_count = 2;
    root.children = {&none, &all};
    const WideBvh bvh = flatten({&root, nullptr}, mesh.positions, mesh.triangles, {});
    EXPECT_EQ(check_bvh(bvh, mesh.positions, mesh.triangles, {}), "");
    EXPECT_EQ(bvh.stack_need, 1U);
}

TEST(WideBvh, SplitsPayForLongDiagonalTriangles) {
    const BvhMesh mesh = test::diagonal_needles(2000, 23);
    const WideBvh plain = build(mesh, {.spatial_splits = false});
    const WideBvh split = build(mesh, {.spatial_splits = true});
    EXPECT_FALSE(plain.has_spatial_splits);
    EXPECT_EQ(leaf_entries(plain.leaves), 2000U);
    EXPECT_TRUE(split.has_spatial_splits);
    EXPECT_GT(leaf_entries(split.leaves), 2000U);
    EXPECT_LT(split.sah_cost, 0.7 * plain.sah_cost);
}

TEST(WideBvh, SplitsAreDroppedWhereTheyDoNotPay) {
    const WideBvh bvh = build(test::flat_grid(40));
    EXPECT_FALSE(bvh.has_spatial_splits);
    EXPECT_EQ(leaf_entries(bvh.leaves), 3200U);
}

TEST(WideBvh, SurfaceAreaHeuristicBeatsTheBalancedTree) {
    const BvhMesh mesh = test::random_soup(10000, 0.02F, 29);
    std::vector<Piece> pieces = make_pieces(mesh.positions, mesh.triangles);
    const WideBvh balanced =
        flatten(build_balanced_tree(pieces, 8), mesh.positions, mesh.triangles, {});
    EXPECT_LT(build(mesh).sah_cost, balanced.sah_cost);
}

TEST(WideBvh, SameInputGivesTheSameTree) {
    for (const bool splits : {false, true}) {
        const BvhMesh mesh = test::diagonal_needles(10000, 31);
        const WideBvh a = build(mesh, {.spatial_splits = splits});
        const WideBvh b = build(mesh, {.spatial_splits = splits});
        EXPECT_EQ(a.has_spatial_splits, splits);
        ASSERT_EQ(a.nodes.size(), b.nodes.size());
        const std::size_t bytes = a.nodes.size() * sizeof(a.nodes[0]);
        // Leaves are numbered in the order of nodes, so equal nodes mean equal leaves.
        EXPECT_EQ(std::memcmp(a.nodes.data(), b.nodes.data(), bytes), 0);
        EXPECT_EQ(sorted_ids(a), sorted_ids(b));
    }
}

TEST(WideBvh, RefusesBadSettingsAndIndices) {
    BvhMesh mesh = test::random_soup(3, 0.1F, 37);
    EXPECT_EQ(code_of_failure(mesh, {.max_leaf_triangles = 0}), ExitCode::usage);
    EXPECT_EQ(code_of_failure(mesh, {.max_leaf_triangles = 9}), ExitCode::usage);
    EXPECT_EQ(code_of_failure(mesh, {.padding = -1.0F}), ExitCode::usage);
    EXPECT_EQ(code_of_failure(mesh, {.padding = std::nanf("")}), ExitCode::usage);
    EXPECT_EQ(code_of_failure(mesh, {.max_stack = 63}), ExitCode::usage);
    EXPECT_EQ(code_of_failure(mesh, {.max_stack = BVH_STACK + 1}), ExitCode::usage);
    EXPECT_EQ(code_of_failure(mesh, {.max_stack = 64}), ExitCode::success);
    EXPECT_EQ(code_of_failure(mesh, {}), ExitCode::success);
    mesh.triangles[1].v2 = 9;
    EXPECT_EQ(code_of_failure(mesh, {}), ExitCode::bad_input);
}

TEST(WideBvh, OutOfMemoryIsAnError) {
    const BvhMesh mesh = test::random_soup(20000, 0.1F, 41);
    const std::vector<Piece> pieces = make_pieces(mesh.positions, mesh.triangles);
    try {
        std::ignore = build_embree_tree(pieces, {.max_bytes = 4096});
        FAIL() << "4 KiB were enough";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::out_of_memory);
    }
}

}  // namespace
}  // namespace weft::wide_bvh_test
