// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_TEXTURE_MAP_H
#define WEFT_SCENE_SURFACE_TEXTURE_MAP_H

#include <cstdint>
#include <glm/glm.hpp>

namespace weft {

/// What a parameter takes of a texture. Alpha is linear in every texture.
enum class Channel : std::uint8_t { rgb, red, green, blue, alpha, luminance };

/// An image that a parameter of a surface is multiplied with, and where it lies.
struct TextureMap {
    int texture = -1;          ///< index into Scene::textures, or -1: none
    std::uint32_t uv_set = 0;  ///< index into Mesh::uv_sets
    glm::dmat3 to_uv{1.0};     ///< affine, applied to (u, v, 1) of that set
    Channel channel = Channel::rgb;

    [[nodiscard]] bool present() const { return texture >= 0; }
    bool operator==(const TextureMap&) const = default;
};

}  // namespace weft

#endif
