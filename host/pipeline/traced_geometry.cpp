// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/traced_geometry.h"

namespace weft {

TracedGeometry traced_geometry(const FlatScene& flat) {
    // Boxes grow by the error of triangle tests: some rounding errors of the largest coordinate.
    // Where the tree changes from frame to frame they hold all that packets count as a hit (2^-19
    // of the distance) but for triangles that a ray sees edge-on.
    const bool moves = flat.first_moving_triangle < flat.triangles.size();
    return {flat.positions, flat.triangles, flat.extent * (moves ? 0x1p-16F : 0x1p-22F),
            flat.first_moving_triangle};
}

}  // namespace weft
