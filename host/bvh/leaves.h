// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_LEAVES_H
#define WEFT_BVH_LEAVES_H

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/large_memory.h"
#include "bvh/convex_polygon.h"
#include "shared/shared_types.h"

namespace weft {

/// Whether a child reference is a leaf (an empty one is not).
[[nodiscard]] constexpr bool is_leaf(std::uint32_t child) noexcept {
    return child != BVH_EMPTY && (child & BVH_LEAF) != 0;
}
/// How many triangles a leaf reference holds.
[[nodiscard]] constexpr std::uint32_t leaf_count(std::uint32_t child) noexcept {
    return child >> BVH_COUNT_SHIFT & BVH_COUNT_MASK;
}
/// The first triangle of a leaf reference, counted over all leaves.
[[nodiscard]] constexpr std::uint32_t leaf_first(std::uint32_t child) noexcept {
    return child & BVH_FIRST_MASK;
}

/// A triangle as a leaf holds it.
struct LeafTriangle {
    Corners corners;
    std::uint32_t id = 0;
};

/// Rows without any leaf: only the padding that whole vectors may read behind the last one.
[[nodiscard]] LargeVector<float> empty_leaves();

/// How many triangles the leaves hold together; 0 where the rows are too short to be valid.
[[nodiscard]] std::size_t leaf_entries(std::span<const float> leaves) noexcept;

/// Appends a leaf in the layout of LEAF_ROWS.
void append_leaf(LargeVector<float>& leaves, std::span<const LeafTriangle> triangles);

/// Triangle `i` of a leaf whose reference lies within the rows.
[[nodiscard]] LeafTriangle leaf_triangle(std::span<const float> leaves, std::uint32_t reference,
                                         std::size_t i) noexcept;

}  // namespace weft

#endif
