// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/coverage.h"

#include <cstddef>
#include <utility>

namespace weft {
namespace {

bool apart(const ConvexPolygon& polygon, const Box& box, double error) noexcept {
    for (std::size_t a = 0; a < 3; ++a)
        if (polygon.lowest(a) > double{box.upper[a]} + error ||
            polygon.highest(a) < double{box.lower[a]} - error)
            return true;
    return false;
}

// Adds the parts of the polygon that lie outside the box, plane by plane.
void add_outside(ConvexPolygon polygon, const Box& box, double error,
                 std::vector<ConvexPolygon>& parts) {
    for (std::size_t a = 0; a < 3; ++a) {
        const double lower = double{box.lower[a]} - error;
        const double upper = double{box.upper[a]} + error;
        if (polygon.lowest(a) < lower) {
            parts.push_back(polygon);
            parts.back().keep_below(a, lower);
            polygon.keep_above(a, lower);
        }
        if (polygon.empty()) return;
        if (polygon.highest(a) > upper) {
            parts.push_back(polygon);
            parts.back().keep_above(a, upper);
            polygon.keep_below(a, upper);
        }
        if (polygon.empty()) return;
    }
}

}  // namespace

bool boxes_cover(const Corners& corners, const std::vector<Box>& boxes) {
    // Boxes count as this much larger, or rounding of the cuts would leave slivers uncovered.
    const double error = clipping_error(corners);
    std::vector<ConvexPolygon> uncovered{ConvexPolygon(corners)};
    std::vector<ConvexPolygon> next;
    for (const Box& box : boxes) {
        next.clear();
        for (const ConvexPolygon& polygon : uncovered) {
            if (!polygon.can_clip() || apart(polygon, box, error))
                next.push_back(polygon);
            else
                add_outside(polygon, box, error, next);
        }
        std::swap(uncovered, next);
    }
    return uncovered.empty();
}

}  // namespace weft
