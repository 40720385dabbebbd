// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_SURFACE_H
#define WEFT_SCENE_GLTF_GLTF_SURFACE_H

#include <cstdint>
#include <optional>
#include <vector>

#include "base/warning_collector.h"
#include "scene/gltf/gltf_textures.h"
#include "scene/surface/surface_description.h"

namespace weft {

/// What a material of a glTF file says of its surface.
struct GltfDescription {
    std::optional<SurfaceDescription> surface{};  ///< empty where it is no more than diffuse
    std::vector<std::uint64_t> uv_sets{};         ///< by TextureMap::uv_set, the n of TEXCOORD_n
};

/// Reads the metallic-roughness surface of a material with its extensions: specular, ior,
/// transmission, volume, clearcoat, anisotropy, unlit, pbrSpecularGlossiness; its normal map and
/// its alpha. Numbers outside of their range are clamped, which `report` names. Throws Error (exit
/// code 2).
[[nodiscard]] GltfDescription read_gltf_surface(const JsonValue& material, GltfTextures& textures,
                                                WarningCollector& report);

/// The surface of primitives without a material.
[[nodiscard]] SurfaceDescription default_gltf_surface();

}  // namespace weft

#endif
