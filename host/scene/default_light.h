// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_DEFAULT_LIGHT_H
#define WEFT_SCENE_DEFAULT_LIGHT_H

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace weft {

/// When a scene gets the default light.
enum class DefaultLight {
    as_needed,  ///< where nothing in it lights it
    always,
    never,
};

/// What lights a scene by itself.
enum class OwnLight {
    none,
    faint,     ///< emission of surfaces that lights too little to see by
    emission,  ///< emission of surfaces
    named,     ///< lights that the file names, even ones that are switched off, or emissive media
};

/// Judges emission as too faint where surfaces of albedo 0.5 would show less than 0.1 of radiance,
/// did all of it fall on them evenly, and no material emits more than 1 all over: an indicator lamp
/// or a label, by textures or without, is no light to see by.
[[nodiscard]] OwnLight own_light(const Scene& scene);

/// Adds the default light where it is wanted, and tells so: a sky of radiance 0.28 all around and a
/// distant light from above the first camera's left shoulder (without cameras: from above the place
/// of the automatic one, y up). A light grey surface then has a radiance of 0.2 to 0.6. Scenes
/// without geometry stay as they are.
void add_default_light(Scene& scene, DefaultLight choice, Diagnostics& diagnostics);

}  // namespace weft

#endif
