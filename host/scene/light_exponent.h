// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_LIGHT_EXPONENT_H
#define WEFT_SCENE_LIGHT_EXPONENT_H

#include "scene/flat_scene.h"

namespace weft {

/// Exponent of the power of two that the brightest radiance of the scene is about, -60 to 60; 0
/// where nothing shines. For lights without area it is that of a surface close to them.
[[nodiscard]] int light_exponent(const FlatScene& scene);

}  // namespace weft

#endif
