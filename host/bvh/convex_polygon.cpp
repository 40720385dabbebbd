// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/convex_polygon.h"

#include <algorithm>
#include <cmath>

namespace weft {

ConvexPolygon::ConvexPolygon(const Corners& corners) noexcept {
    for (std::size_t i = 0; i < 3; ++i)
        vertices_[i] = {double{corners[i].x}, double{corners[i].y}, double{corners[i].z}};
}

double ConvexPolygon::lowest(std::size_t axis) const noexcept {
    double result = vertices_[0][axis];
    for (std::size_t i = 1; i < size_; ++i) result = std::min(result, vertices_[i][axis]);
    return result;
}

double ConvexPolygon::highest(std::size_t axis) const noexcept {
    double result = vertices_[0][axis];
    for (std::size_t i = 1; i < size_; ++i) result = std::max(result, vertices_[i][axis]);
    return result;
}

void ConvexPolygon::clip(std::size_t axis, double plane, double side) noexcept {
    // Most planes of a box miss the polygon, which then need not be rewritten.
    bool inside = true;
    for (std::size_t i = 0; i < size_; ++i) inside &= side * (vertices_[i][axis] - plane) >= 0.0;
    if (inside) return;

    std::array<Point, capacity> result;
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
        const Point& a = vertices_[i];
        const Point& b = vertices_[i + 1 == size_ ? 0 : i + 1];
        const double from_a = side * (a[axis] - plane);
        const double from_b = side * (b[axis] - plane);
        if (from_a >= 0.0 && count < capacity) result[count++] = a;
        // A vertex on the plane is its own crossing.
        if ((from_a > 0.0 && from_b < 0.0) || (from_a < 0.0 && from_b > 0.0)) {
            if (count == capacity) continue;
            const double t = from_a / (from_a - from_b);
            Point& crossing = result[count++];
            for (std::size_t k = 0; k < 3; ++k) crossing[k] = a[k] + t * (b[k] - a[k]);
            crossing[axis] = plane;
        }
    }
    std::copy_n(result.begin(), count, vertices_.begin());
    size_ = count;
}

double clipping_error(const Corners& corners) noexcept {
    double largest = 0.0;
    for (const shared::float4& corner : corners)
        largest = std::max({largest, std::abs(double{corner.x}), std::abs(double{corner.y}),
                            std::abs(double{corner.z})});
    // A crossing errs by at most eight roundings of the largest coordinate relative to the polygon
    // as stored, so errors of successive clips add up and are never amplified. 2^-53 * 8 * 10 <
    // 2^-46.
    return 0x1p-46 * largest;
}

}  // namespace weft
