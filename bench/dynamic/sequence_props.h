// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_SEQUENCE_PROPS_H
#define WEFT_BENCH_DYNAMIC_SEQUENCE_PROPS_H

#include "scene/scene.h"

namespace weft::bench {

// Meshes of things that move in sequences; +y is up.

/// The unit cube about the origin.
[[nodiscard]] Mesh prop_box();
/// A slab of height 1 that stands on the origin: its hinge is the y axis, it reaches 0.45 along +x.
[[nodiscard]] Mesh prop_door();
/// A board on four legs that stands on the origin, 1.4 wide, 1 high and 0.9 deep.
[[nodiscard]] Mesh prop_table();
/// A seat with a back on four legs that stands on the origin, 1 high.
[[nodiscard]] Mesh prop_chair();
/// A cupboard with an open front, a board in it: it stands on the origin, 1 high.
[[nodiscard]] Mesh prop_shelf();

/// A body of 2048 triangles with smooth normals that stands on the origin, 1 high; see pose_figure.
[[nodiscard]] Mesh prop_figure();
/// Moves the vertices of that mesh to another moment, radians of a turn that repeats itself: the
/// body bends and twists while its foot stays.
void pose_figure(Mesh& figure, double moment);

}  // namespace weft::bench

#endif
