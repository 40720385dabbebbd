// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_LIGHT_TREE_H
#define WEFT_SCENE_LIGHT_TREE_H

#include <span>
#include <vector>

#include "shared/shared_types.h"

namespace weft {

/// Builds the tree from which paths choose lights (kernels/light/light_tree.h), the root first and
/// the children of a node one after the other. `lights` are those that paths choose from, in kernel
/// units, which get the index of their leaf; `intensities` say how bright each is: luminance of the
/// radiance times area or of the intensity, of directional lights of the irradiance, and of an
/// environment of the mean irradiance. At least one light.
[[nodiscard]] std::vector<shared::LightNode> build_light_tree(std::span<shared::LightRecord> lights,
                                                              std::span<const double> intensities);

}  // namespace weft

#endif
