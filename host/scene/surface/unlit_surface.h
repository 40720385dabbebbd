// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_UNLIT_SURFACE_H
#define WEFT_SCENE_SURFACE_UNLIT_SURFACE_H

#include "scene/surface/surface_parameter.h"

namespace weft {

/// A surface that shows its colour whatever lights it, and lights nothing (KHR_materials_unlit).
struct UnlitSurface {
    ColourParameter colour{};  ///< times vertex colour
};

}  // namespace weft

#endif
