// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_WIDE_BVH_H
#define WEFT_BVH_WIDE_BVH_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "base/large_memory.h"
#include "bvh/leaves.h"
#include "shared/shared_types.h"

namespace weft {

/// How a BVH is built.
struct BvhSettings {
    bool spatial_splits = true;            ///< tried, and kept where they lower the SAH cost enough
    std::uint32_t max_leaf_triangles = 8;  ///< at most NODE_WIDTH, which are tested at once
    float padding = 0.0F;  ///< outward growth of every box, kernel units, on top of rounding
    std::uint32_t max_stack = BVH_STACK;  ///< entries that a traversal may need, at least 64
};

/// A BVH of width NODE_WIDTH in the layout kernels traverse. Node 0 is the root; a scene without
/// triangles has a root of empty children.
struct WideBvh {
    LargeVector<shared::BvhNode> nodes;
    LargeVector<float> leaves = empty_leaves();  ///< LEAF_ROWS; spatial splits repeat triangles
    std::uint32_t depth = 0;                     ///< nodes on the longest path
    std::uint32_t stack_need = 0;  ///< entries the deepest traversal can push, <= BVH_STACK
    bool has_spatial_splits = false;
    double sah_cost = 0.0;
    double build_ms = 0.0;
    bool from_cache = false;  ///< was read by a BvhCache, not built
};

/// Statistics of a BVH, which remain once it is on a device.
struct BvhStats {
    std::size_t nodes = 0;
    std::size_t triangles = 0;  ///< leaf entries; spatial splits repeat some
    std::size_t bytes = 0;
    std::uint32_t depth = 0;
    bool has_spatial_splits = false;
    double sah_cost = 0.0;
    double build_ms = 0.0;
    bool from_cache = false;
};

[[nodiscard]] inline BvhStats stats_of(const WideBvh& bvh) {
    return {bvh.nodes.size(),
            leaf_entries(bvh.leaves),
            bvh.nodes.size() * sizeof(shared::BvhNode) + bvh.leaves.size() * sizeof(float),
            bvh.depth,
            bvh.has_spatial_splits,
            bvh.sah_cost,
            bvh.build_ms,
            bvh.from_cache};
}

/// Builds with Embree's `rtcBuildBVH` over the triangles from `first` on. Triangles whose area is
/// exactly zero or whose vertices are not finite are left out, since no ray can hit them. Throws
/// Error (exit code 4 when memory runs out).
[[nodiscard]] WideBvh build_bvh(std::span<const shared::float4> positions,
                                std::span<const shared::Triangle> triangles,
                                const BvhSettings& settings, std::size_t first = 0);

/// Checks every invariant that traversal relies on; returns the first violation, or an empty text.
[[nodiscard]] std::string check_bvh(const WideBvh& bvh, std::span<const shared::float4> positions,
                                    std::span<const shared::Triangle> triangles,
                                    const BvhSettings& settings);

}  // namespace weft

#endif
