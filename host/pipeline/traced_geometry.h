// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_TRACED_GEOMETRY_H
#define WEFT_PIPELINE_TRACED_GEOMETRY_H

#include "device/executor.h"
#include "scene/flat_scene.h"

namespace weft {

/// The triangles of a scene that rays meet. The scene must outlive it.
[[nodiscard]] TracedGeometry traced_geometry(const FlatScene& flat);

}  // namespace weft

#endif
