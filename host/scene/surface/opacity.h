// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_OPACITY_H
#define WEFT_SCENE_SURFACE_OPACITY_H

#include <cstdint>

#include "scene/surface/surface_parameter.h"

namespace weft {

enum class OpacityMode : std::uint8_t {
    opaque,  ///< alpha has no effect
    mask,    ///< there where alpha is at least the cut-off, else not
    blend,   ///< alpha is the share of light that meets the surface; the rest passes straight on
};

/// Where a surface is not there at all.
struct Opacity {
    OpacityMode mode = OpacityMode::opaque;
    float cutoff = 0.5F;      ///< of `mask`
    ScalarParameter alpha{};  ///< times alpha of the vertices (Mesh::alphas)
};

}  // namespace weft

#endif
