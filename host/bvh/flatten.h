// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_FLATTEN_H
#define WEFT_BVH_FLATTEN_H

#include <cstddef>
#include <cstdint>
#include <span>

#include "bvh/box.h"
#include "bvh/build_tree.h"
#include "bvh/wide_bvh.h"

namespace weft {

/// A node whose children no ray can hit.
[[nodiscard]] shared::BvhNode empty_node() noexcept;

/// Makes `reference` with its box child `slot` of a node.
void set_child(shared::BvhNode& node, std::size_t slot, const Box& box,
               std::uint32_t reference) noexcept;

/// The box of child `slot` of a node.
[[nodiscard]] Box child_box(const shared::BvhNode& node, std::size_t slot) noexcept;

/// Cost of a BVH by the surface area heuristic: node and leaf tests that a random ray through the
/// root's box needs on average, both counted as 1. 0 without triangles.
[[nodiscard]] double sah_cost(const WideBvh& bvh) noexcept;

/// Lays the tree out depth first, a node right before the subtree of its first child, so that
/// what a ray visits lies close together. Boxes are the union of those below, leaf boxes the union
/// of the pieces grown by the padding and one float; leaves that are too large become subtrees.
/// Sets everything but `build_ms`. Throws Error (exit code 2) where the layout has too few bits.
[[nodiscard]] WideBvh flatten(const BuildTree& tree, std::span<const shared::float4> positions,
                              std::span<const shared::Triangle> triangles,
                              const BvhSettings& settings);

}  // namespace weft

#endif
