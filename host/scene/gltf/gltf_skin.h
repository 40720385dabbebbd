// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_SKIN_H
#define WEFT_SCENE_GLTF_GLTF_SKIN_H

#include <cstddef>
#include <map>
#include <vector>

#include "scene/deformation.h"
#include "scene/gltf/gltf_data.h"
#include "scene/gltf/gltf_nodes.h"

namespace weft {

/// A skin of the file in the scene that is rendered.
struct GltfSkin {
    std::size_t number = 0;           ///< in the file
    glm::dmat4 to_world{1.0};         ///< of the frame, at rest
    Attachment motion{};              ///< of the frame
    std::vector<glm::dmat4> at_rest;  ///< joint matrices; not finite where `to_world` is singular
    bool moves = false;               ///< joints move in the frame
    Skin skin;
};

/// The skins of a document, each read at its first use.
class GltfSkins {
  public:
    /// `nodes` as read_gltf_nodes returns them; they may be filled in later.
    GltfSkins(const GltfDocument& document, GltfData& data, const std::vector<GltfNode>& nodes);

    /// The skin whose index `reference` holds; it stays valid. Its frame is the nearest node above
    /// all joints, or the world. Throws Error (exit code 2).
    [[nodiscard]] const GltfSkin& skin(const JsonValue& reference);

  private:
    [[nodiscard]] std::vector<std::size_t> read_joints(const JsonValue& value);
    [[nodiscard]] std::size_t frame_of(const std::vector<std::size_t>& joints) const;
    [[nodiscard]] GltfSkin read(const JsonValue& value, std::size_t number);

    JsonValue root_;
    GltfData& data_;
    const std::vector<GltfNode>& nodes_;
    std::vector<std::size_t> positions_;  ///< by node of the file, in `nodes_`
    std::size_t joints_read_ = 0;
    std::map<std::size_t, GltfSkin> known_;
};

}  // namespace weft

#endif
