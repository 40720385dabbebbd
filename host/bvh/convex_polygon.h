// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_CONVEX_POLYGON_H
#define WEFT_BVH_CONVEX_POLYGON_H

#include <array>
#include <cstddef>

#include "shared/shared_types.h"

namespace weft {

using Point = std::array<double, 3>;
using Corners = std::array<shared::float4, 3>;

/// A planar convex polygon in double precision, made from a triangle by clipping.
class ConvexPolygon {
  public:
    /// Room for vertices. A triangle cut by axis-aligned planes has nine edges at most: its own and
    /// two along each kind of plane. The rest is for edges that rounding leaves.
    static constexpr std::size_t capacity = 24;

    explicit ConvexPolygon(const Corners& corners) noexcept;

    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }

    /// Smallest and largest coordinate along `axis`; not for an empty polygon.
    [[nodiscard]] double lowest(std::size_t axis) const noexcept;
    [[nodiscard]] double highest(std::size_t axis) const noexcept;

    /// Keeps the part with coordinate `axis` at most `plane`.
    void keep_below(std::size_t axis, double plane) noexcept { clip(axis, plane, -1.0); }

    /// Keeps the part with coordinate `axis` at least `plane`.
    void keep_above(std::size_t axis, double plane) noexcept { clip(axis, plane, 1.0); }

    /// Whether seven more clips are sure to find room for their vertices.
    [[nodiscard]] bool can_clip() const noexcept { return size_ + 7 <= capacity; }

  private:
    void clip(std::size_t axis, double plane, double side) noexcept;

    std::array<Point, capacity> vertices_;
    std::size_t size_ = 3;
};

/// Bound on how far clipping a triangle some ten times moves any vertex of the result.
[[nodiscard]] double clipping_error(const Corners& corners) noexcept;

}  // namespace weft

#endif
