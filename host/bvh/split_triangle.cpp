// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/split_triangle.h"

#include <algorithm>
#include <cmath>

namespace weft {

SplitBoxes split_triangle(const Corners& corners, const Box& piece, std::size_t axis,
                          float position) noexcept {
    const std::array<std::array<float, 3>, 3> vertices{
        {{corners[0].x, corners[0].y, corners[0].z},
         {corners[1].x, corners[1].y, corners[1].z},
         {corners[2].x, corners[2].y, corners[2].z}}};
    Box below;
    Box above;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& a = vertices[i];
        const auto& b = vertices[i == 2 ? 0 : i + 1];
        if (a[axis] <= position) below.extend({a, a});
        if (a[axis] >= position) above.extend({a, a});
        if (!(a[axis] < position && position < b[axis]) &&
            !(b[axis] < position && position < a[axis]))
            continue;
        // The error covers a few roundings of double, and the one to float below.
        const double length = double{b[axis]} - double{a[axis]};
        const double t = (double{position} - double{a[axis]}) / length;
        Box crossing;
        for (std::size_t k = 0; k < 3; ++k) {
            const double value = double{a[k]} + t * (double{b[k]} - double{a[k]});
            const double largest = std::max(std::abs(double{a[k]}), std::abs(double{b[k]}));
            const double error = 0x1p-49 * largest + 0x1p-23 * std::abs(value) + 0x1p-149;
            crossing.lower[k] = static_cast<float>(value - error);
            crossing.upper[k] = static_cast<float>(value + error);
        }
        below.extend(crossing);
        above.extend(crossing);
    }
    // Inside the piece the half cannot reach past the plane, nor past where the piece ends. Cutting
    // out the very polygon inside the piece would lower the cost of scenes by 0.03 percent at most.
    Box limit_below = piece;
    Box limit_above = piece;
    limit_below.upper[axis] = std::min(piece.upper[axis], position);
    limit_above.lower[axis] = std::max(piece.lower[axis], position);
    return {below.common(limit_below), above.common(limit_above)};
}

}  // namespace weft
