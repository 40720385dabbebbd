// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_LAMBERT_SURFACE_H
#define WEFT_SCENE_SURFACE_LAMBERT_SURFACE_H

#include "scene/surface/surface_parameter.h"

namespace weft {

/// A Lambertian surface under a normal map or with gaps: what DiffuseSurface cannot say.
struct LambertSurface {
    ColourParameter colour{};  ///< times vertex colour
};

}  // namespace weft

#endif
