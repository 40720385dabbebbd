// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_texture_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "base/finite.h"
#include "base/limits.h"

namespace weft {

GltfUvs read_gltf_uvs(const JsonValue& info) {
    GltfUvs uvs;
    uvs.set = info.integer_or("texCoord", 0);
    const std::optional<JsonValue> transform = info.extension("KHR_texture_transform");
    if (!transform) return uvs;
    uvs.set = transform->integer_or("texCoord", uvs.set);
    const std::array<double, 2> offset = transform->numbers_or<2>("offset", {0.0, 0.0});
    const std::array<double, 2> scale = transform->numbers_or<2>("scale", {1.0, 1.0});
    const double rotation = transform->number_or("rotation", 0.0);
    const double c = std::cos(rotation);
    const double s = std::sin(rotation);
    uvs.transform = glm::dmat3(glm::dvec3(c * scale[0], -s * scale[0], 0.0),
                               glm::dvec3(s * scale[1], c * scale[1], 0.0),
                               glm::dvec3(offset[0], offset[1], 1.0));
    return uvs;
}

TextureMap GltfTextureMaps::read(const JsonValue& owner, const char* key, Channel channel,
                                 bool srgb) {
    const std::optional<JsonValue> info = owner.find(key);
    if (!info) return {};
    // Before the image, so that a texture that is left out costs nothing.
    const GltfUvs uvs = read_gltf_uvs(*info);
    const auto known = std::find(uv_sets_.begin(), uv_sets_.end(), uvs.set);
    if (known == uv_sets_.end() && uv_sets_.size() == limits::max_uv_sets) {
        report_.count(info->place(), {"texture", "textures"},
                      "more than " + std::to_string(limits::max_uv_sets) +
                          " sets of texture coordinates in a material, left out");
        return {};
    }
    const std::optional<int> texture =
        textures_.add(info->at("index"), {.srgb = srgb, .alpha = channel == Channel::alpha});
    if (!texture) return {};
    TextureMap map;
    map.texture = *texture;
    map.channel = channel;
    map.uv_set = static_cast<std::uint32_t>(known - uv_sets_.begin());
    if (known == uv_sets_.end()) uv_sets_.push_back(uvs.set);
    map.to_uv = uvs.transform;
    for (int column = 0; column < 3; ++column)
        if (!is_finite(glm::vec3(map.to_uv[column]))) {
            report_.count(info->place(), {"texture", "textures"},
                          "the texture transform is too large, left out");
            map.to_uv = glm::dmat3(1.0);
        }
    return map;
}

}  // namespace weft
