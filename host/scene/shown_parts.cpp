// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/shown_parts.h"

#include <cstddef>

namespace weft {

std::vector<bool> shown_materials(const Scene& scene) {
    std::vector<bool> shown(scene.materials.size());
    for (const Instance& instance : scene.instances) shown[instance.material] = true;
    return shown;
}

std::vector<bool> shown_textures(const Scene& scene) {
    const std::vector<bool> materials = shown_materials(scene);
    std::vector<bool> shown(scene.textures.size());
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        if (!materials[m]) continue;
        const Material& material = scene.materials[m];
        for (const int texture : {albedo_texture(material), material.emission.texture})
            if (texture >= 0) shown[static_cast<std::size_t>(texture)] = true;
        if (!material.description) continue;
        for (const TextureMap* const map : texture_maps(*material.description))
            shown[static_cast<std::size_t>(map->texture)] = true;
    }
    return shown;
}

}  // namespace weft
