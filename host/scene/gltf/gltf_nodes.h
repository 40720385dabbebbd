// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_NODES_H
#define WEFT_SCENE_GLTF_GLTF_NODES_H

#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

#include "base/warning_collector.h"
#include "scene/gltf/gltf_animation.h"
#include "scene/gltf/gltf_document.h"

namespace weft {

/// A node of the scene that is rendered.
struct GltfNode {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    JsonValue value;
    std::size_t number = 0;     ///< in the file
    std::size_t parent = none;  ///< among the nodes that are rendered, or `none`
    std::string name{};         ///< empty where the file gives none
    glm::dmat4 to_world{1.0};   ///< at rest
    Attachment motion{};        ///< to itself or the nearest animated node above it
    int weights_track = -1;     ///< of its morph targets: index into Animation::tracks, or -1
};

/// The nodes of the default scene (or the first, or all root nodes where there are no scenes),
/// parents before children, each branch in the order of the file. Refuses cycles, nodes with two
/// parents and nesting beyond `limits::max_nesting` with an Error (exit code 2). The `animated`
/// ones among them become `animation.nodes`.
[[nodiscard]] std::vector<GltfNode> read_gltf_nodes(const GltfDocument& document,
                                                    const GltfAnimatedNodes& animated,
                                                    Animation& animation, WarningCollector& report);

/// Whether things of `node` can be placed with `to_world`: throws Error (exit code 2) where that is
/// not finite; warns and returns false where it flattens space, as exporters do to hide objects.
[[nodiscard]] bool usable_transform(const glm::dmat4& to_world, const JsonValue& node,
                                    WarningCollector& report);

}  // namespace weft

#endif
