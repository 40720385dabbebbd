// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_EMBREE_TREE_H
#define WEFT_BVH_EMBREE_TREE_H

#include <cstddef>
#include <cstdint>
#include <span>

#include "bvh/build_tree.h"

namespace weft {

/// Limits for Embree's builder.
struct EmbreeBuild {
    std::uint32_t max_leaf = 8;        ///< pieces in a leaf
    std::uint32_t max_depth = 32;      ///< nodes and a leaf on the longest path
    std::size_t max_bytes = SIZE_MAX;  ///< of Embree's memory; more counts as out of memory
};

/// Builds a tree over the pieces by the surface area heuristic, without splits of triangles. It
/// depends on the pieces alone. Throws Error (exit code 4 when memory runs out, 3 for other
/// failures of Embree).
[[nodiscard]] BuildTree build_embree_tree(std::span<const Piece> pieces,
                                          const EmbreeBuild& request);

}  // namespace weft

#endif
