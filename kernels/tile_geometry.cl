// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What the G-buffer says about undersampling a tile: which pixels are lit, and how coarse a lattice
// serves each. A pixel is served by a lattice if the taps that lie on its own surface hold most of
// the weight. One work-item per tile, row by row.
#include "discontinuity.h"
#include "lattice.h"

// Of the weight of its taps, what a pixel must find on its own surface.
#define ENOUGH_SUPPORT 0.7f
// A tile needs no test of single taps where it and they keep to this share of the tolerances about
// one pixel of it: any two of them then keep to the whole.
#define SMOOTH_SHARE 0.25f

static inline float lattice_support(const Params* params, GLOBAL const uint* gb_ids,
                                    GLOBAL const float4* gb_albedo,
                                    GLOBAL const float4* gb_position,
                                    GLOBAL const float4* gb_shading, const PixelSurface* surface,
                                    int x, int y, int stride) {
    int width = (int)params->width;
    int height = (int)params->height;
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

/// 1 where all lit pixels of the tile and all coarse lattice points about it are one smooth
/// surface.
static inline int tile_is_smooth(const Params* params, GLOBAL const uint* gb_ids,
                                 GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                 GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                                 int left, int top) {
    int width = (int)params->width;
    int height = (int)params->height;
    // The taps of a tile at the border may lie further inside.
    if (left < 4 || top < 4 || left + 16 > width || top + 16 > height) return 0;
    uint centre = (uint)((top + 4) * width + left + 4);
    if (pixel_is_lit(gb_ids, gb_albedo, centre) == 0) return 0;
    PixelSurface surface =
        pixel_surface(params, gb_position, gb_normal, gb_shading, centre, SMOOTH_SHARE);
    for (int y = top - 4; y <= top + 12; y += 4) {
        for (int x = left - 4; x <= left + 12; x += 4) {
            uint other = (uint)(y * width + x);
            if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) return 0;
            if (on_surface(&surface, gb_position, gb_shading, other) == 0) return 0;
        }
    }
    for (int y = top; y < top + TILE_EDGE; ++y) {
        for (int x = left; x < left + TILE_EDGE; ++x) {
            uint other = (uint)(y * width + x);
            if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) return 0;
            if (on_surface(&surface, gb_position, gb_shading, other) == 0) return 0;
        }
    }
    return 1;
}

WEFT_KERNEL(tile_geometry)
(PARAMS, GBUFFER_ARGS, GLOBAL TileRecord* tiles) {
    if (GLOBAL_ID >= params.count) return;
    uint tile = params.first + GLOBAL_ID;
    int width = (int)params.width;
    int height = (int)params.height;
    uint columns = (params.width + TILE_EDGE - 1u) / TILE_EDGE;
    int left = (int)(tile % columns) * TILE_EDGE;
    int top = (int)(tile / columns) * TILE_EDGE;
    TileRecord record;
    record.flags = 0u;
    record.pad = 0u;
    for (uint half_tile = 0u; half_tile < 2u; ++half_tile) {
        record.lit[half_tile] = 0u;
        record.middle[half_tile] = 0u;
        record.fine[half_tile] = 0u;
    }
    if (tile_is_smooth(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, left, top) !=
        0) {
        record.flags = TILE_SMOOTH;
        record.lit[0] = 0xFFFFFFFFu;
        record.lit[1] = 0xFFFFFFFFu;
        tiles[tile] = record;
        return;
    }
    for (uint bit = 0u; bit < 64u; ++bit) {
        int x = left + (int)(bit % TILE_EDGE);
        int y = top + (int)(bit / TILE_EDGE);
        if (x >= width || y >= height) continue;
        uint pixel = (uint)(y * width + x);
        if (pixel_is_lit(gb_ids, gb_albedo, pixel) == 0) continue;
        uint word = bit / 32u;
        uint mask = 1u << (bit % 32u);
        record.lit[word] |= mask;
        PixelSurface surface =
            pixel_surface(&params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
        if (lattice_support(&params, gb_ids, gb_albedo, gb_position, gb_shading, &surface, x, y,
                            4) >= ENOUGH_SUPPORT)
            continue;
        if (lattice_support(&params, gb_ids, gb_albedo, gb_position, gb_shading, &surface, x, y,
                            2) >= ENOUGH_SUPPORT)
            record.middle[word] |= mask;
        else
            record.fine[word] |= mask;
    }
    tiles[tile] = record;
}
