// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_COVERAGE_H
#define WEFT_BVH_COVERAGE_H

#include <vector>

#include "bvh/box.h"
#include "bvh/convex_polygon.h"

namespace weft {

/// Whether the union of closed boxes holds the whole triangle, except slivers narrower than the
/// rounding of double arithmetic. Cuts every box out of the triangle and tests whether any of it
/// remains.
[[nodiscard]] bool boxes_cover(const Corners& corners, const std::vector<Box>& boxes);

}  // namespace weft

#endif
