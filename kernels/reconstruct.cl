// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance of every pixel by the discontinuity buffer, where every pixel has a sample. Texture
// never passes through it.
#include "discontinuity.h"

WEFT_KERNEL(reconstruct)
(PARAMS, GBUFFER_ARGS, GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance,
 GLOBAL float4* filtered) {
    if (GLOBAL_ID >= params.count) return;
    uint pixel = params.first + GLOBAL_ID;
    if (pixel_is_lit(gb_ids, gb_albedo, pixel) == 0) {
        filtered[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        return;
    }
    PixelSurface surface = pixel_surface(&params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
    filtered[pixel] = window_mean(&params, gb_ids, gb_albedo, gb_position, gb_shading, &surface,
                                  pixel_slot, irradiance, pixel);
}
