// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_TRANSFORM_H
#define WEFT_SCENE_TRANSFORM_H

#include <glm/glm.hpp>

namespace weft {

/// Whether a finite transform flattens what it is applied to: by its determinant, compared with the
/// volume that its columns would span at right angles, so that the size of a scene does not matter.
[[nodiscard]] bool is_singular(const glm::dmat4& transform);

}  // namespace weft

#endif
