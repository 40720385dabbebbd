// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance of every pixel from undersampled tiles. `tile_stride` holds each tile's lattice (1, 2
// or 4); pixels that need a finer one, by tile_geometry, use it. At stride 1 this is the
// discontinuity buffer of reconstruct.cl. One work-item per tile.
#include "discontinuity.h"
#include "lattice.h"

#define SMOOTH_POINTS 5  // lattice points along an edge of a smooth tile with its taps

/// Interpolates at a lit pixel of any tile: taps on other surfaces are left out.
static inline float4 lattice_mean(const Params* params, GLOBAL const uint* gb_ids,
                                  GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                  GLOBAL const float4* gb_shading, const PixelSurface* surface,
                                  GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance,
                                  int x, int y, int stride) {
    int width = (int)params->width;
    int height = (int)params->height;
    LatticeTaps across = lattice_taps(x, stride, width);
    LatticeTaps down = lattice_taps(y, stride, height);
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    float weight = 0.0f;
    for (uint j = 0u; j < LATTICE_TAPS; ++j) {
        int row = (down.first + (int)j) * stride;
        if (row < 0 || row >= height) continue;
        for (uint i = 0u; i < LATTICE_TAPS; ++i) {
            int column = (across.first + (int)i) * stride;
            float share = across.weight[i] * down.weight[j];
            if (column < 0 || column >= width || share == 0.0f) continue;
            uint other = (uint)(row * width + column);
            if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) continue;
            uint slot = pixel_slot[other];
            if (slot == NO_TRIANGLE) continue;
            if (on_surface(surface, gb_position, gb_shading, other) == 0) continue;
            sum += slot_irradiance(irradiance, params->slots, slot) * share;
            weight += share;
        }
    }
    float share = weight > 0.0f ? 1.0f / weight : 0.0f;
    return f4(sum.x * share, sum.y * share, sum.z * share, weight);
}

/// A tile that is one smooth surface with its taps, at stride 4: no tap needs a test.
static inline void interpolate_smooth(const Params* params, GLOBAL const uint* pixel_slot,
                                      GLOBAL const float* irradiance, int left, int top,
                                      GLOBAL float4* filtered) {
    float3 rows[SMOOTH_POINTS][TILE_EDGE];
    for (int j = 0; j < SMOOTH_POINTS; ++j) {
        float3 points[SMOOTH_POINTS];
        for (int i = 0; i < SMOOTH_POINTS; ++i) {
            uint pixel = (uint)(top + 4 * j - 4) * params->width + (uint)(left + 4 * i - 4);
            points[i] = slot_irradiance(irradiance, params->slots, pixel_slot[pixel]);
        }
        for (int x = 0; x < TILE_EDGE; ++x) {
            float f = 0.25f * (float)(x % 4);
            int i = x / 4;
            rows[j][x] =
                (points[i] * (1.0f - f) + points[i + 1] + points[i + 2] + points[i + 3] * f) *
                0.333333333f;
        }
    }
    for (int y = 0; y < TILE_EDGE; ++y) {
        float f = 0.25f * (float)(y % 4);
        int j = y / 4;
        GLOBAL float4* line = filtered + (uint)(top + y) * params->width + (uint)left;
        for (int x = 0; x < TILE_EDGE; ++x) {
            float3 mean =
                (rows[j][x] * (1.0f - f) + rows[j + 1][x] + rows[j + 2][x] + rows[j + 3][x] * f) *
                0.333333333f;
            line[x] = f4(mean.x, mean.y, mean.z, 1.0f);
        }
    }
}

WEFT_KERNEL(reconstruct_tiles)
(PARAMS, GBUFFER_ARGS, GLOBAL const TileRecord* tiles, GLOBAL const uint* tile_stride,
 GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance, GLOBAL float4* filtered) {
    if (GLOBAL_ID >= params.count) return;
    uint tile = params.first + GLOBAL_ID;
    TileRecord record = tiles[tile];
    int stride = (int)tile_stride[tile];
    int width = (int)params.width;
    int height = (int)params.height;
    uint columns = (params.width + TILE_EDGE - 1u) / TILE_EDGE;
    int left = (int)(tile % columns) * TILE_EDGE;
    int top = (int)(tile / columns) * TILE_EDGE;
    if (stride == 4 && (record.flags & TILE_SMOOTH) != 0u) {
        interpolate_smooth(&params, pixel_slot, irradiance, left, top, filtered);
        return;
    }
    for (uint bit = 0u; bit < 64u; ++bit) {
        int x = left + (int)(bit % TILE_EDGE);
        int y = top + (int)(bit / TILE_EDGE);
        if (x >= width || y >= height) continue;
        uint pixel = (uint)(y * width + x);
        uint word = bit / 32u;
        uint mask = 1u << (bit % 32u);
        if ((record.lit[word] & mask) == 0u) {
            filtered[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
            continue;
        }
        int own = stride;
        if ((record.middle[word] & mask) != 0u && own > 2) own = 2;
        if ((record.fine[word] & mask) != 0u) own = 1;
        PixelSurface surface =
            pixel_surface(&params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
        filtered[pixel] = own == 1
                              ? window_mean(&params, gb_ids, gb_albedo, gb_position, gb_shading,
                                            &surface, pixel_slot, irradiance, pixel)
                              : lattice_mean(&params, gb_ids, gb_albedo, gb_position, gb_shading,
                                             &surface, pixel_slot, irradiance, x, y, own);
    }
}
