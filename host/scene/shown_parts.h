// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SHOWN_PARTS_H
#define WEFT_SCENE_SHOWN_PARTS_H

#include <vector>

#include "scene/scene.h"

namespace weft {

/// By material: whether an instance has it. What a file only names costs nothing.
[[nodiscard]] std::vector<bool> shown_materials(const Scene& scene);

/// By texture: whether a material that is shown has it.
[[nodiscard]] std::vector<bool> shown_textures(const Scene& scene);

}  // namespace weft

#endif
