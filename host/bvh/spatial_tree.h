// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_SPATIAL_TREE_H
#define WEFT_BVH_SPATIAL_TREE_H

#include <cstddef>
#include <cstdint>
#include <span>

#include "bvh/build_tree.h"

namespace weft {

/// Limits of a tree with spatial splits.
struct SpatialBuild {
    std::uint32_t max_leaf = 8;    ///< pieces in a leaf; more only at `max_depth`
    std::uint32_t max_depth = 32;  ///< nodes and a leaf on the longest path
    std::size_t room = 0;          ///< pieces that cuts may add
};

/// Builds a tree over the pieces by the surface area heuristic, in which a triangle may lie in
/// several leaves, by pieces that together hold all of it (Stich, Friedrich and Dietrich 2009).
/// Nodes are filled as by Embree's builder: the child with the largest surface is split first.
///
/// The tree depends on the arguments alone, whatever the threads. Throws std::bad_alloc.
///
/// Embree's own builder with splits is not used: it searches for splits among pieces that it will
/// not cut any more, so that one side of a split can be empty, which ends the process where its
/// assertions are compiled in, as they are in Debian's package.
[[nodiscard]] BuildTree build_spatial_tree(std::span<const Piece> pieces,
                                           std::span<const shared::float4> positions,
                                           std::span<const shared::Triangle> triangles,
                                           const SpatialBuild& request);

}  // namespace weft

#endif
