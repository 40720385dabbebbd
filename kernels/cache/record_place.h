// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Place and bounds of the radius of a new irradiance record, from the pixel that it is made at.
#ifndef WEFT_KERNELS_CACHE_RECORD_PLACE_H
#define WEFT_KERNELS_CACHE_RECORD_PLACE_H

#include "kernels/cache/cache.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"
#include "kernels/film/camera.h"

// Largest radius of a record, in edges of a square as large as a pixel on its surface. The least is
// the width of its own pixel: with an error of 0 every pixel is a record.
#define MOST_PIXELS 20.0f

/// Stores the place of a new record and the bounds of its radius.
static inline void store_place(const RenderParams* params, GLOBAL const float4* gb_position,
                               GLOBAL const float4* gb_normal, uint pixel, uint stride,
                               GLOBAL float* record) {
    float4 at = gb_position[pixel];
    float across = pixel_width(params, at.w);
    record[RECORD_LEAST * stride] = across;
    record[RECORD_MOST * stride] = MOST_PIXELS * square_root(gb_normal[pixel].w * across);
    record[RECORD_PLACE * stride] = at.x;
    record[(RECORD_PLACE + 1u) * stride] = at.y;
    record[(RECORD_PLACE + 2u) * stride] = at.z;
}

#endif
