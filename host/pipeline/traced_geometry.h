// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_TRACED_GEOMETRY_H
#define WEFT_PIPELINE_TRACED_GEOMETRY_H

#include <vector>

#include "device/executor.h"
#include "scene/flat_scene.h"

namespace weft {

/// The triangles of a scene that rays meet. The scene must outlive it.
[[nodiscard]] TracedGeometry traced_geometry(const FlatScene& flat);

/// The triangles that block light in previews, in the places of all: those of instances that light
/// passes (FlatSurfaces::passes_light) have no area. Empty where all instances block light.
[[nodiscard]] std::vector<shared::Triangle> blocking_triangles(const FlatScene& flat);

}  // namespace weft

#endif
