// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_PIECES_H
#define WEFT_BVH_PIECES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bvh/box.h"
#include "bvh/convex_polygon.h"
#include "bvh/embree.h"
#include "shared/shared_types.h"

namespace weft {

/// The primitive that a tree is built from: the box of a triangle, or of a part of it after spatial
/// splits. `primID` is the triangle; `geomID` is 0.
using Piece = RTCBuildPrimitive;

/// The vertices of a triangle whose indices are known to be valid.
[[nodiscard]] Corners corners_of(std::span<const shared::float4> positions,
                                 const shared::Triangle& triangle) noexcept;

/// False for triangles that no ray can hit: zero area, or vertices that are not finite.
[[nodiscard]] bool can_be_hit(const Corners& corners) noexcept;

/// The smallest box of floats around a triangle.
[[nodiscard]] Box box_of(const Corners& corners) noexcept;

/// The box of a piece.
[[nodiscard]] Box box_of(const Piece& piece) noexcept;

/// The middle of a piece's box, rounded to float.
[[nodiscard]] std::array<float, 3> centre_of(const Piece& piece) noexcept;

/// A piece of the same triangle with another box.
[[nodiscard]] Piece with_box(const Piece& piece, const Box& box) noexcept;

/// One piece for each triangle from `first` on that can be hit, in order.
/// Throws Error (exit code 2) where a vertex index is out of range or there are too many triangles.
[[nodiscard]] std::vector<Piece> make_pieces(std::span<const shared::float4> positions,
                                             std::span<const shared::Triangle> triangles,
                                             std::size_t first = 0);

}  // namespace weft

#endif
