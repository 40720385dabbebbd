// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds out from the G-buffer how far a tile may be undersampled: which pixels are lit, and which
// lattice is the coarsest that serves each. A lattice serves a pixel if its taps on the pixel's own
// surface have at least the weight FilterParams::enough_support. One work-item per tile, row by
// row.
#include "kernels/adaptive/lattice.h"
#include "kernels/adaptive/tile_footprint.h"
#include "kernels/core/kernel.h"

// A tile is smooth, and its taps need no tests, where it and they keep to this share of the
// tolerances about one pixel of it: any two of them then keep to the whole tolerances.
#define SMOOTH_SHARE 0.25f

static inline float lattice_support(const RenderParams* params, GLOBAL const uint* gb_ids,
                                    GLOBAL const float4* gb_albedo,
                                    GLOBAL const float4* gb_position,
                                    GLOBAL const float4* gb_shading, const PixelSurface* surface,
                                    int x, int y, int stride) {
    int width = (int)params->camera.width;
    int height = (int)params->camera.height;
    LatticeTaps across = lattice_taps(x, stride, width);
    LatticeTaps down = lattice_taps(y, stride, height);
    float support = 0.0f;
    for (uint j = 0u; j < LATTICE_TAPS; ++j) {
        int row = (down.first + (int)j) * stride;
        if (row < 0 || row >= height) continue;
        for (uint i = 0u; i < LATTICE_TAPS; ++i) {
            int column = (across.first + (int)i) * stride;
            if (column < 0 || column >= width) continue;
            uint other = (uint)(row * width + column);
            if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) continue;
            if (on_surface(surface, gb_position, gb_shading, other) == 0) continue;
            support += across.weight[i] * down.weight[j];
        }
    }
    return support;
}

/// 1 where all pixels of a tile, all lit, and all coarse lattice points about it are one smooth
/// surface.
static inline int tile_is_smooth(const RenderParams* params, GLOBAL const uint* gb_ids,
                                 GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                 GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                                 const TileFootprint* footprint, int left, int top) {
    int width = (int)params->camera.width;
    uint centre = (uint)((top + 4) * width + left + 4);
    PixelSurface surface =
        pixel_surface(params, gb_position, gb_normal, gb_shading, centre, SMOOTH_SHARE);
    for (uint y = 0u; y < TILE_EDGE; ++y) {
        SurfaceRow row = surface_row(footprint, y);
        if (node_mask_bits(row_lies_on(&row, &surface)) != 0xFFu) return 0;
    }
    for (int y = top - 4; y <= top + 12; y += 4) {
        for (int x = left - 4; x <= left + 12; x += 4) {
            uint other = (uint)(y * width + x);
            if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) return 0;
            if (on_surface(&surface, gb_position, gb_shading, other) == 0) return 0;
        }
    }
    return 1;
}

/// Pixels of a tile inside the image that the lattice serves, as two words.
static inline void served_inside(const RenderParams* params, GLOBAL const uint* gb_ids,
                                 GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                 GLOBAL const float4* gb_shading, const TileFootprint* footprint,
                                 int left, int top, int stride, uint points,
                                 CONSTANT_POINTER float* weights, uint* served) {
    NFloat support[TILE_EDGE];
    SurfaceRow rows[TILE_EDGE];
    for (uint y = 0u; y < TILE_EDGE; ++y) {
        support[y] = NODE(0.0f);
        rows[y] = surface_row(footprint, y);
    }
    for (uint j = 0u; j < points; ++j) {
        for (uint i = 0u; i < points; ++i) {
            int x = left + ((int)i - 1) * stride;
            int y = top + ((int)j - 1) * stride;
            uint other = (uint)(y * (int)params->camera.width + x);
            if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) continue;
            float3 position = xyz(gb_position[other]);
            float3 shading = xyz(gb_shading[other]);
            NFloat across = node_load(weights + TILE_EDGE * i);
            for (uint row = 0u; row < TILE_EDGE; ++row) {
                float down = weights[TILE_EDGE * j + row];
                if (down == 0.0f) continue;
                NMask holds = row_holds(&rows[row], position, shading, params->filter.cosine);
                support[row] = support[row] + SELECT(holds, across * down, NODE(0.0f));
            }
        }
    }
    served[0] = 0u;
    served[1] = 0u;
    for (uint row = 0u; row < TILE_EDGE; ++row)
        served[row / 4u] |= node_mask_bits(support[row] >= NODE(params->filter.enough_support))
                            << (row % 4u * TILE_EDGE);
}

/// The same for any tile, pixel by pixel.
static inline void served_at_border(const RenderParams* params, GLOBAL const uint* gb_ids,
                                    GLOBAL const float4* gb_albedo,
                                    GLOBAL const float4* gb_position,
                                    GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                                    const TileFootprint* footprint, int left, int top, int stride,
                                    uint* served) {
    served[0] = 0u;
    served[1] = 0u;
    for (uint bit = 0u; bit < 64u; ++bit) {
        if ((footprint->lit[bit / 32u] >> (bit % 32u) & 1u) == 0u) continue;
        int x = left + (int)(bit % TILE_EDGE);
        int y = top + (int)(bit / TILE_EDGE);
        PixelSurface surface = pixel_surface(params, gb_position, gb_normal, gb_shading,
                                             (uint)(y * (int)params->camera.width + x), 1.0f);
        if (lattice_support(params, gb_ids, gb_albedo, gb_position, gb_shading, &surface, x, y,
                            stride) >= params->filter.enough_support)
            served[bit / 32u] |= 1u << (bit % 32u);
    }
}

WEFT_KERNEL(tile_geometry)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint tile = range.first + WORK_ITEM(range);
    uint columns = tile_columns(&params);
    int left = (int)(tile % columns) * TILE_EDGE;
    int top = (int)(tile / columns) * TILE_EDGE;
    TileFootprint footprint;
    load_footprint(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, left, top, 0,
                   &footprint);
    TileRecord record;
    record.flags = 0u;
    record.pad = 0u;
    int inside = tile_is_inside(&params, left, top);
    int all = (footprint.lit[0] & footprint.lit[1]) == 0xFFFFFFFFu ? 1 : 0;
    if (inside != 0 && all != 0 &&
        tile_is_smooth(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, &footprint,
                       left, top) != 0)
        record.flags = TILE_SMOOTH;
    uint coarse[2] = {0xFFFFFFFFu, 0xFFFFFFFFu};
    uint middle[2] = {0xFFFFFFFFu, 0xFFFFFFFFu};
    if (record.flags == 0u && inside != 0) {
        served_inside(&params, gb_ids, gb_albedo, gb_position, gb_shading, &footprint, left, top, 4,
                      TILE_POINTS_4, tile_weights_4, coarse);
        if (((footprint.lit[0] & ~coarse[0]) | (footprint.lit[1] & ~coarse[1])) != 0u)
            served_inside(&params, gb_ids, gb_albedo, gb_position, gb_shading, &footprint, left,
                          top, 2, TILE_POINTS_2, tile_weights_2, middle);
    } else if (record.flags == 0u) {
        served_at_border(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, &footprint,
                         left, top, 4, coarse);
        served_at_border(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, &footprint,
                         left, top, 2, middle);
    }
    for (uint word = 0u; word < 2u; ++word) {
        record.lit[word] = footprint.lit[word];
        record.middle[word] = footprint.lit[word] & ~coarse[word] & middle[word];
        record.fine[word] = footprint.lit[word] & ~coarse[word] & ~middle[word];
    }
    tiles[tile] = record;
}
