// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/spatial_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bvh/flatten.h"
#include "tests/testing/bvh_meshes.h"

namespace weft::spatial_tree_test {
namespace {

using test::BvhMesh;

std::size_t pieces_in(const BuildNode& node) {
    std::size_t sum = node.piece_count;
    for (std::uint32_t i = 0; i < node.child_count; ++i)
        sum += pieces_in(*static_cast<const BuildInner&>(node).children[i]);
    return sum;
}

std::uint32_t depth_of(const BuildNode& node) {
    std::uint32_t depth = 0;
    for (std::uint32_t i = 0; i < node.child_count; ++i)
        depth = std::max(depth, depth_of(*static_cast<const BuildInner&>(node).children[i]));
    return depth + 1;
}

// Builds, and fails the test where the tree breaks a limit or an invariant.
std::size_t built_pieces(const BvhMesh& mesh, const SpatialBuild& request) {
    const std::vector<Piece> pieces = make_pieces(mesh.positions, mesh.triangles);
    const BuildTree tree = build_spatial_tree(pieces, mesh.positions, mesh.triangles, request);
    if (tree.root == nullptr) return 0;
    EXPECT_LE(pieces_in(*tree.root), pieces.size() + request.room);
    EXPECT_LE(depth_of(*tree.root), request.max_depth);
    const BvhSettings settings{.max_leaf_triangles = request.max_leaf};
    const WideBvh bvh = flatten(tree, mesh.positions, mesh.triangles, settings);
    EXPECT_EQ(check_bvh(bvh, mesh.positions, mesh.triangles, settings), "");
    EXPECT_LE(bvh.depth, request.max_depth);
    return pieces_in(*tree.root);
}

TEST(SpatialTree, KeepsRoomDepthAndLeafSize) {
    const BvhMesh mesh = test::diagonal_needles(3000, 5);
    EXPECT_EQ(built_pieces(mesh, {.room = 0}), 3000U);
    built_pieces(mesh, {.room = 1});
    built_pieces(mesh, {.room = 100});
    EXPECT_GT(built_pieces(mesh, {.room = 3000}), 4000U);
    EXPECT_GT(built_pieces(mesh, {.room = 30000}), 4000U);
    for (const std::uint32_t max_leaf : {1U, 3U, 8U})
        for (const std::uint32_t max_depth : {5U, 6U, 8U, 32U})
            built_pieces(mesh, {.max_leaf = max_leaf, .max_depth = max_depth, .room = 3000});
    EXPECT_EQ(built_pieces({}, {.room = 100}), 0U);
    EXPECT_EQ(built_pieces(test::random_soup(1, 0.5F, 1), {.room = 100}), 1U);
}

// What a builder with fixed numbers of cuts for each triangle fails on: pieces that are cut again
// and again, and coordinates that lie on the very planes.
TEST(SpatialTree, HostileMeshesKeepEveryInvariant) {
    test::Uniform uniform(11);
    for (int i = 0; i < 400; ++i) {
        BvhMesh mesh;
        const int steps = 1 << (i % 5 + 1);
        const float scale = std::ldexp(1.0F, i % 7 * 12 - 36);
        const auto value = [&] {
            const float place = std::floor(uniform(0.0F, static_cast<float>(steps) + 0.999F));
            const float jitter = i % 3 == 0 ? uniform(-1e-6F, 1e-6F) : 0.0F;
            return scale * (place / static_cast<float>(steps) + jitter);
        };
        const auto point = [&] { return std::array<float, 3>{value(), value(), value()}; };
        const int count = 1 + i % 97;
        for (int k = 0; k < count; ++k) {
            mesh.add(point(), point(), point());
            if (k % 4 == 3) mesh.triangles.push_back(mesh.triangles.back());
        }
        built_pieces(mesh, {.max_leaf = i % 2 == 0 ? 8U : 1U, .room = mesh.triangles.size() * 8});
    }
}

}  // namespace
}  // namespace weft::spatial_tree_test
