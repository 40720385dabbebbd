// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_ANIMATION_H
#define WEFT_SCENE_GLTF_GLTF_ANIMATION_H

#include <cstddef>
#include <map>
#include <vector>

#include "base/warning_collector.h"
#include "scene/animation.h"
#include "scene/gltf/gltf_data.h"
#include "scene/gltf/gltf_document.h"

namespace weft {

/// Which tracks change a node: indices into Animation::tracks, or -1.
struct GltfChannels {
    int translation = -1, rotation = -1, scale = -1;
    int weights = -1;  ///< of the morph targets of its mesh

    [[nodiscard]] bool move_node() const noexcept {
        return translation >= 0 || rotation >= 0 || scale >= 0;
    }
};

/// The animated nodes by their index in the file.
using GltfAnimatedNodes = std::map<std::size_t, GltfChannels>;

/// Reads every animation of a document, all of which play at once from time 0 on, and appends its
/// clip and its tracks. Of several channels for one property of a node, the first counts. Throws
/// Error (exit code 2).
[[nodiscard]] GltfAnimatedNodes read_gltf_animations(const GltfDocument& document, GltfData& data,
                                                     WarningCollector& report,
                                                     Animation& animation);

}  // namespace weft

#endif
