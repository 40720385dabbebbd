// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_LIGHTS_H
#define WEFT_SCENE_GLTF_GLTF_LIGHTS_H

#include <cstddef>
#include <optional>

#include "scene/gltf/gltf_nodes.h"
#include "scene/scene.h"

namespace weft {

/// The KHR_lights_punctual light of a node whose transform is usable, if it has one. Throws Error
/// (exit code 2).
[[nodiscard]] std::optional<PunctualLight> read_gltf_light(const JsonValue& root,
                                                           const GltfNode& node,
                                                           WarningCollector& report);

/// The camera of a node whose transform is usable, if it has one. `number` names a camera without a
/// name. Throws Error (exit code 2).
[[nodiscard]] std::optional<Camera> read_gltf_camera(const JsonValue& root, const GltfNode& node,
                                                     std::size_t number);

}  // namespace weft

#endif
