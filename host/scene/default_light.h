// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_DEFAULT_LIGHT_H
#define WEFT_SCENE_DEFAULT_LIGHT_H

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace weft {

/// Whether the scene names a light of any kind, even one that is switched off.
[[nodiscard]] bool has_light(const Scene& scene);

/// Lights a scene that names no light, with a warning: a sky of radiance 0.28 all around and a
/// distant light from above the first camera's left shoulder (without cameras: from above the place
/// of the automatic one, y up). A light grey surface then has a radiance of 0.2 to 0.6. Scenes
/// without geometry stay as they are.
void add_default_light(Scene& scene, Diagnostics& diagnostics);

}  // namespace weft

#endif
