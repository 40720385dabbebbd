// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_CLOSED_MESH_H
#define WEFT_SCENE_CLOSED_MESH_H

#include "scene/scene.h"

namespace weft {

/// Whether the triangles of a mesh enclose a volume without a gap: at every edge as many turn one
/// way as the other. Vertices at equal positions count as one, triangles without area by position
/// as none.
[[nodiscard]] bool is_closed(const Mesh& mesh);

}  // namespace weft

#endif
