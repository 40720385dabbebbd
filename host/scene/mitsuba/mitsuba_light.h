// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_LIGHT_H
#define WEFT_SCENE_MITSUBA_MITSUBA_LIGHT_H

#include "scene/mitsuba/mitsuba_object.h"
#include "scene/scene.h"

namespace weft::mitsuba {

/// Adds an `<emitter>` that stands outside of shapes: point, spot, directional, constant or envmap.
/// Others are named in a warning and left out. Throws Error (exit code 2) for wrong values.
void read_light(const Element& emitter, Context& context, Scene& scene);

}  // namespace weft::mitsuba

#endif
