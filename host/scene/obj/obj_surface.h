// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_OBJ_OBJ_SURFACE_H
#define WEFT_SCENE_OBJ_OBJ_SURFACE_H

#include <cstdint>
#include <functional>
#include <optional>

#include "base/warning_collector.h"
#include "scene/obj/obj_mtl.h"
#include "scene/surface/surface_description.h"

namespace weft {

/// What the image of a map stands for.
enum class MtlMapUse : std::uint8_t { colour, normals, number, alpha };

/// Adds the image of a map to the scene, and says where it lies and which channel is meant; none
/// where it cannot be read.
using MtlMapReader = std::function<TextureMap(const MtlMap& map, MtlMapUse use)>;

/// What an MTL material says of its surface; empty where that is no more than diffuse. The diffuse
/// colour and its texture are `diffuse`. By Pr or Pm it is metal and roughness; by illum and Ks a
/// mirror, glass, or a coat on the diffuse surface. Glass is solid: whoever knows the mesh says
/// otherwise. Numbers outside of their range are clamped, which `report` names.
[[nodiscard]] std::optional<SurfaceDescription> describe_mtl(const MtlMaterial& source,
                                                             const ColourParameter& diffuse,
                                                             const MtlMapReader& read_map,
                                                             WarningCollector& report);

}  // namespace weft

#endif
