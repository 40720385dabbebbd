// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_TEXTURES_H
#define WEFT_SCENE_GLTF_GLTF_TEXTURES_H

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "base/warning_collector.h"
#include "scene/gltf/gltf_data.h"
#include "scene/scene.h"

namespace weft {

/// How a texture is used.
struct GltfTextureUse {
    bool srgb = true;    ///< its colours are sRGB encoded; false: data
    bool alpha = false;  ///< its alpha is used, which is linear in either case
};

/// Decodes the images that materials refer to, each once for each use, within
/// `limits::max_texture_bytes` for the whole file.
class GltfTextures {
  public:
    GltfTextures(const GltfDocument& document, GltfData& data, WarningCollector& report,
                 std::vector<Texture>& textures);

    /// Index into the scene's textures for the glTF texture whose index `reference` holds; nothing
    /// where the texture has no image that Weft can read. Throws Error (exit code 2).
    [[nodiscard]] std::optional<int> add(const JsonValue& reference,
                                         const GltfTextureUse& use = {});

    /// The image whose index `reference` holds, which is no texture of the scene: decoded anew each
    /// time. Throws Error (exit code 2).
    [[nodiscard]] Texture image(const JsonValue& reference);

  private:
    [[nodiscard]] std::optional<std::size_t> image_of(const JsonValue& texture, std::size_t index);
    [[nodiscard]] Texture decode(std::size_t image);

    JsonValue root_;
    GltfData& data_;
    WarningCollector& report_;
    std::vector<Texture>& textures_;
    std::size_t decoded_bytes_ = 0;
    std::set<std::size_t> without_image_;  ///< numbers of textures
    std::map<std::tuple<std::size_t, Wrap, Wrap, bool, bool>, int> added_;
};

}  // namespace weft

#endif
