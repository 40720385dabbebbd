// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Prepares lookups of irradiance records: computes the bounds of each tile's surfaces, and marks
// all its lit pixels as missing irradiance. One work-item per tile.
#include "kernels/core/kernel.h"
#include "kernels/film/discontinuity.h"
#include "kernels/film/edges.h"

WEFT_KERNEL(cache_tiles)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint tile = range.first + WORK_ITEM(range);
    uint columns = tile_columns(&params);
    uint left = tile % columns * TILE_EDGE;
    uint top = tile / columns * TILE_EDGE;
    float3 lower = f3(M_INFINITY, M_INFINITY, M_INFINITY);
    float3 upper = -lower;
    uint lit[2] = {0u, 0u};
    for (uint bit = 0u; bit < (uint)(TILE_EDGE * TILE_EDGE); ++bit) {
        uint x = left + bit % TILE_EDGE;
        uint y = top + bit / TILE_EDGE;
        if (x >= params.camera.width || y >= params.camera.height) continue;
        uint pixel = y * params.camera.width + x;
        filtered[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        if (pixel_is_lit(gb_ids, gb_albedo, pixel) == 0) continue;
        lit[bit / 32u] |= 1u << (bit % 32u);
        lower = lowest3(lower, xyz(gb_position[pixel]));
        upper = highest3(upper, xyz(gb_position[pixel]));
    }
    tile_boxes[2u * tile] = f4(lower.x, lower.y, lower.z, 0.0f);
    tile_boxes[2u * tile + 1u] = f4(upper.x, upper.y, upper.z, 0.0f);
    missing[2u * tile] = lit[0];
    missing[2u * tile + 1u] = lit[1];
}
