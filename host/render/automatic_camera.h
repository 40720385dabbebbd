// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_AUTOMATIC_CAMERA_H
#define WEFT_RENDER_AUTOMATIC_CAMERA_H

#include "scene/flat_scene.h"
#include "scene/scene.h"
#include "scene/scene_bounds.h"

namespace weft {

/// A camera that shows all of `bounds`, as closely as an image of any aspect allows, with +y up:
/// from the front, the right and a little above. Of a scene that is flat it shows the wide side, a
/// picture from its front and terrain from above, and a long one it shows from the side; `scene`
/// says which it is. Where `bounds` is empty, it shows the sphere about the scene.
[[nodiscard]] Camera automatic_camera(const FlatScene& scene, const SceneBounds& bounds);

}  // namespace weft

#endif
