// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/traced_geometry.h"

#include <algorithm>

namespace weft {

TracedGeometry traced_geometry(const FlatScene& flat) {
    // Boxes grow by the error of triangle tests: some rounding errors of the largest coordinate.
    // Where the tree changes from frame to frame they hold all that packets count as a hit (2^-19
    // of the distance) but for triangles that a ray sees edge-on.
    const bool moves = flat.first_moving_triangle < flat.triangles.size();
    return {flat.positions, flat.triangles, flat.extent * (moves ? 0x1p-16F : 0x1p-22F),
            flat.first_moving_triangle};
}

std::vector<shared::Triangle> blocking_triangles(const FlatScene& flat) {
    const std::vector<bool>& passes = flat.surfaces.passes_light;
    if (std::find(passes.begin(), passes.end(), true) == passes.end()) return {};
    std::vector<shared::Triangle> triangles = flat.triangles;
    for (shared::Triangle& triangle : triangles)
        if (passes[triangle.instance]) triangle.v1 = triangle.v2 = triangle.v0;
    return triangles;
}

}  // namespace weft
