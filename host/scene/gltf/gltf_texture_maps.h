// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_TEXTURE_MAPS_H
#define WEFT_SCENE_GLTF_GLTF_TEXTURE_MAPS_H

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/warning_collector.h"
#include "scene/gltf/gltf_textures.h"
#include "scene/surface/texture_map.h"

namespace weft {

/// Which texture coordinates a texture is looked up by.
struct GltfUvs {
    std::uint64_t set = 0;      ///< n of TEXCOORD_n
    glm::dmat3 transform{1.0};  ///< KHR_texture_transform, applied to (u, v, 1)

    bool operator==(const GltfUvs&) const = default;
};

/// Reads the set of texture coordinates and the transform of a textureInfo. Positive rotation turns
/// the coordinates counter-clockwise as seen with v pointing down.
[[nodiscard]] GltfUvs read_gltf_uvs(const JsonValue& info);

/// Reads the textures of one material's description, and gathers which sets of texture coordinates
/// they lie by.
class GltfTextureMaps {
  public:
    GltfTextureMaps(GltfTextures& textures, WarningCollector& report)
        : textures_(textures), report_(report) {}

    /// The texture of the textureInfo that `owner` has as `key`; none where there is none, or no
    /// image that Weft can read. `srgb`: its colours are sRGB, not data. Throws Error (exit code
    /// 2).
    [[nodiscard]] TextureMap read(const JsonValue& owner, const char* key, Channel channel,
                                  bool srgb);

    /// By TextureMap::uv_set, the n of TEXCOORD_n.
    [[nodiscard]] const std::vector<std::uint64_t>& uv_sets() const { return uv_sets_; }

  private:
    GltfTextures& textures_;
    WarningCollector& report_;
    std::vector<std::uint64_t> uv_sets_;
};

}  // namespace weft

#endif
