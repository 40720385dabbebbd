// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Filters the residual of every pixel (vpl_residual.cl) through the discontinuity buffer, and adds
// it to irradiance that was interpolated from fewer samples. Where every pixel has a sample, the
// residual is added before reconstruct.cl, which filters both. One work-item per pixel.
#include "kernels/core/kernel.h"
#include "kernels/film/discontinuity.h"

WEFT_KERNEL(filter_residual)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    if (pixel_is_lit(gb_ids, gb_albedo, pixel) == 0) return;
    PixelSurface surface = pixel_surface(&params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
    float4 residual = footprint_mean(&params, gb_ids, gb_albedo, gb_position, gb_shading, &surface,
                                     pixel_slot, irradiance, slots, pixel);
    float4 other = filtered[pixel];
    filtered[pixel] = f4(other.x + residual.x, other.y + residual.y, other.z + residual.z, other.w);
}
