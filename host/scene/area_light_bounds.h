// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_AREA_LIGHT_BOUNDS_H
#define WEFT_SCENE_AREA_LIGHT_BOUNDS_H

#include <cstddef>
#include <span>

#include "scene/flat_scene.h"
#include "shared/shared_types.h"

namespace weft {

/// Most triangles of an area light that counts as a panel: its light is summed over them, for every
/// pixel.
inline constexpr std::size_t max_panel_triangles = 16;

/// Bounds of an area light, kernel units: shared::LightRecord::position and axis.
struct AreaLightBounds {
    shared::float4 ball{};    ///< xyz middle of its corners, w distance of the furthest of them
    shared::float4 normal{};  ///< xyz unit normal of an area light that is one flat panel, else 0
};

/// Bounds of emissive triangles of the scene, of which there is at least one and none is of area 0.
[[nodiscard]] AreaLightBounds area_light_bounds(
    const FlatScene& flat, std::span<const shared::EmissiveTriangle> area_light);

}  // namespace weft

#endif
