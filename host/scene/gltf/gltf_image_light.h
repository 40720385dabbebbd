// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_IMAGE_LIGHT_H
#define WEFT_SCENE_GLTF_GLTF_IMAGE_LIGHT_H

#include <optional>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_textures.h"
#include "scene/scene.h"

namespace weft {

/// The image of the environment that the default scene names by EXT_lights_image_based, if any.
/// Throws Error (exit code 2).
[[nodiscard]] std::optional<Environment> read_gltf_image_light(const JsonValue& root,
                                                               GltfTextures& textures);

}  // namespace weft

#endif
