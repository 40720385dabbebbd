// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_BUILD_TREE_H
#define WEFT_BVH_BUILD_TREE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <type_traits>

#include "bvh/pieces.h"

namespace weft {

/// Number of children of a wide node.
inline constexpr std::size_t node_width = std::extent_v<decltype(shared::BvhNode::child)>;

/// A node of the tree as it is built, before it gets the layout of the kernels: a BuildInner where
/// it has children, else a BuildLeaf. All memory belongs to an arena; nothing is ever destroyed.
struct BuildNode {
    std::uint32_t child_count = 0;
    std::uint32_t piece_count = 0;
};
struct BuildInner : BuildNode {
    std::array<BuildNode*, node_width> children{};
};
struct BuildLeaf : BuildNode {
    const Piece* pieces = nullptr;
};
static_assert(std::is_trivially_destructible_v<BuildInner>);
static_assert(std::is_trivially_destructible_v<BuildLeaf>);

/// A built tree with the arena that holds it; `root` is null when there was nothing to build.
struct BuildTree {
    BuildNode* root = nullptr;
    std::shared_ptr<void> arena;
};

/// Builds by splitting the pieces at the median of their centres until a leaf has at most
/// `max_leaf`, so that the depths of leaves differ by one at most. Slow to traverse; for pieces
/// that Embree's builder cannot order well. Reorders `pieces`. Throws std::bad_alloc.
[[nodiscard]] BuildTree build_balanced_tree(std::span<Piece> pieces, std::uint32_t max_leaf);

/// The same, inside a given arena. `pieces` must live as long as the tree.
[[nodiscard]] BuildNode* build_balanced_tree(std::span<Piece> pieces, std::uint32_t max_leaf,
                                             std::pmr::memory_resource& arena);

}  // namespace weft

#endif
