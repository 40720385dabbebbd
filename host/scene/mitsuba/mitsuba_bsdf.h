// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_BSDF_H
#define WEFT_SCENE_MITSUBA_MITSUBA_BSDF_H

#include <optional>

#include "scene/mitsuba/mitsuba_object.h"
#include "scene/mitsuba/mitsuba_texture.h"
#include "scene/surface/surface_description.h"

namespace weft::mitsuba {

/// The surface of a bsdf that stands for itself: conductor, dielectric, plastic, with their rough
/// and thin kinds, and principled. Nothing for other types. Throws Error (exit code 2) for wrong
/// values; what Mitsuba does by default is what is meant where nothing is said.
[[nodiscard]] std::optional<SurfaceModel> read_bsdf_model(Object& object, TextureReader& textures,
                                                          Context& context);

/// The normals of a `normalmap`. Throws Error (exit code 2) where it has no texture of that name.
[[nodiscard]] NormalMap read_normal_map(Object& object, TextureReader& textures);

/// The share of a surface that a `mask` leaves.
[[nodiscard]] Opacity read_opacity(Object& object, TextureReader& textures);

}  // namespace weft::mitsuba

#endif
