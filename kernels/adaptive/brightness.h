// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells how visible small changes of luminance are, by the table of host/adaptive/brightness.h.
#ifndef WEFT_KERNELS_ADAPTIVE_BRIGHTNESS_H
#define WEFT_KERNELS_ADAPTIVE_BRIGHTNESS_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"

/// Just noticeable differences per unit of radiance, at a luminance of `radiance`. Negative values
/// and NaN count as 0.
static inline float brightness_slope(GLOBAL const float* slopes, float radiance) {
    if (!(radiance > 0.0f)) return slopes[0];
    uint entry = as_bits(radiance) >> SLOPE_DROPPED_BITS;
    return slopes[entry < SLOPE_ENTRIES ? entry : SLOPE_ENTRIES - 1u];
}

#endif
