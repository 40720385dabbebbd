// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_NODES_H
#define WEFT_SCENE_GLTF_NODES_H

#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

#include "scene/gltf_animation.h"
#include "scene/gltf_document.h"
#include "scene/gltf_report.h"

namespace weft {

/// A node of the scene that is rendered.
struct GltfNode {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    GltfValue value;
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
                                                    Animation& animation, GltfReport& report);

/// Translation, rotation and scale of a node, where they are there. Throws Error (exit code 2)
/// where the rotation is far from unit length.
[[nodiscard]] Pose read_gltf_pose(const GltfValue& node);

/// The `matrix` of an object, 16 numbers by columns; else the identity. Throws Error (exit code 2)
/// where it is not affine.
[[nodiscard]] glm::dmat4 read_gltf_matrix(const GltfValue& value);

/// Whether things of `node` can be placed with `to_world`: throws Error (exit code 2) where that is
/// not finite; warns and returns false where it flattens space, as exporters do to hide objects.
[[nodiscard]] bool usable_transform(const glm::dmat4& to_world, const GltfValue& node,
                                    GltfReport& report);

}  // namespace weft

#endif
