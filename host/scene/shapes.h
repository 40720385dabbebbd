// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SHAPES_H
#define WEFT_SCENE_SHAPES_H

#include "scene/scene.h"

namespace weft {

/// The square [-1,1]^2 in the plane z = 0 with normal +z; uv runs from (0,0) at (-1,-1) to (1,1).
[[nodiscard]] Mesh make_rectangle();

/// The cube [-1,1]^3: six faces with four vertices each, outward normals, uv 0..1 on every face.
[[nodiscard]] Mesh make_cube();

/// The unit sphere in 5,040 triangles: 72 meridians, 36 bands, all vertices on the sphere and
/// smooth outward normals. u is the longitude from +x over 2 pi, v the angle from +z over pi.
[[nodiscard]] Mesh make_sphere();

/// The unit disk in the plane z = 0 with normal +z, in 128 segments; u is the radius, v the angle
/// from +x over 2 pi.
[[nodiscard]] Mesh make_disk();

}  // namespace weft

#endif
