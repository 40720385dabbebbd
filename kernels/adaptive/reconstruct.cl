// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Reconstructs the irradiance of every pixel by the discontinuity buffer, where every pixel has a
// sample. Textures stay sharp, since irradiance is filtered without the albedo. One work-item per
// tile.
#include "kernels/adaptive/tile_footprint.h"
#include "kernels/core/kernel.h"

WEFT_KERNEL(reconstruct)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint tile = range.first + WORK_ITEM(range);
    int left = (int)(tile % tile_columns(&params)) * TILE_EDGE;
    int top = (int)(tile / tile_columns(&params)) * TILE_EDGE;
    TileFootprint footprint;
    TileMeans means;
    load_footprint(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, left, top, 1,
                   &footprint);
    if (params.filter.radius == 1u) {
        TileSamples samples;
        load_samples(&params, pixel_slot, irradiance, slots, left, top, &samples);
        footprint_means(&params, &footprint, &samples, &means);
    }
    for (uint bit = 0u; bit < TILE_EDGE * TILE_EDGE; ++bit) {
        int x = left + (int)(bit % TILE_EDGE);
        int y = top + (int)(bit / TILE_EDGE);
        if (x >= (int)params.camera.width || y >= (int)params.camera.height) continue;
        uint pixel = (uint)(y * (int)params.camera.width + x);
        filtered[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        if ((footprint.lit[bit / 32u] >> (bit % 32u) & 1u) == 0u) continue;
        if (footprint_is_centred(&params, x, y) != 0) {
            filtered[pixel] = mean_of(&means, bit);
            continue;
        }
        PixelSurface surface =
            pixel_surface(&params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
        filtered[pixel] = footprint_mean(&params, gb_ids, gb_albedo, gb_position, gb_shading,
                                         &surface, pixel_slot, irradiance, slots, pixel);
    }
}
