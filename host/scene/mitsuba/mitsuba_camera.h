// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_CAMERA_H
#define WEFT_SCENE_MITSUBA_MITSUBA_CAMERA_H

#include "scene/mitsuba/mitsuba_medium.h"
#include "scene/mitsuba/mitsuba_object.h"
#include "scene/scene.h"

namespace weft::mitsuba {

/// Adds a `<sensor>` to Scene::cameras, with the film size and the medium around it. The first
/// sensor decides where several disagree. Sensors other than perspective ones are named in a
/// warning and left out. Throws Error (exit code 2) for wrong values.
void read_camera(const Element& sensor, Context& context, MediumReader& media, Scene& scene);

}  // namespace weft::mitsuba

#endif
