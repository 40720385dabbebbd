// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_SPLIT_TRIANGLE_H
#define WEFT_BVH_SPLIT_TRIANGLE_H

#include <cstddef>

#include "bvh/box.h"
#include "bvh/convex_polygon.h"

namespace weft {

/// The boxes of the two halves of a triangle's piece; a half without any of the triangle is empty.
struct SplitBoxes {
    Box below, above;
};

/// Splits the part of a triangle inside `piece` at `position` along `axis`. Each result holds all
/// of its half, lies inside `piece` and on its side of the plane, and is tight to two floats.
[[nodiscard]] SplitBoxes split_triangle(const Corners& corners, const Box& piece, std::size_t axis,
                                        float position) noexcept;

}  // namespace weft

#endif
