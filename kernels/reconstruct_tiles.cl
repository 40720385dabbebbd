// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance of every pixel from undersampled tiles. `tile_stride` holds each tile's lattice (1, 2
// or 4); pixels that need a finer one, by tile_geometry, use it. At stride 1 this is the
// discontinuity buffer of reconstruct.cl. One work-item per tile.
#include "discontinuity.h"
#include "lattice.h"

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

typedef struct {
    NFloat red, green, blue;  // of a row of pixels
} PixelRow;

/// A row of lattice points to a row of pixels.
static inline PixelRow smooth_row(const Params* params, GLOBAL const uint* pixel_slot,
                                  GLOBAL const float* irradiance, uint pixel) {
    PixelRow row = {NODE(0.0f), NODE(0.0f), NODE(0.0f)};
    for (uint i = 0u; i < TILE_POINTS_4; ++i) {
        float3 point = slot_irradiance(irradiance, params->slots, pixel_slot[pixel + 4u * i]);
        NFloat weight = node_load(tile_weights_4 + TILE_EDGE * i);
        row.red = row.red + weight * point.x;
        row.green = row.green + weight * point.y;
        row.blue = row.blue + weight * point.z;
    }
    return row;
}

/// A tile that is one smooth surface with its taps, at stride 4: no tap needs a test.
static inline void interpolate_smooth(const Params* params, GLOBAL const uint* pixel_slot,
                                      GLOBAL const float* irradiance, uint left, uint top,
                                      GLOBAL float4* filtered) {
    PixelRow rows[TILE_POINTS_4];
    for (uint j = 0u; j < TILE_POINTS_4; ++j)
        rows[j] = smooth_row(params, pixel_slot, irradiance,
                             (top + 4u * j - 4u) * params->width + left - 4u);
    for (uint y = 0u; y < TILE_EDGE; ++y) {
        PixelRow mean = {NODE(0.0f), NODE(0.0f), NODE(0.0f)};
        for (uint j = 0u; j < TILE_POINTS_4; ++j) {
            float weight = tile_weights_4[TILE_EDGE * j + y];
            mean.red = mean.red + rows[j].red * weight;
            mean.green = mean.green + rows[j].green * weight;
            mean.blue = mean.blue + rows[j].blue * weight;
        }
        float red[TILE_EDGE];
        float green[TILE_EDGE];
        float blue[TILE_EDGE];
        node_store(mean.red, red);
        node_store(mean.green, green);
        node_store(mean.blue, blue);
        GLOBAL float4* line = filtered + (top + y) * params->width + left;
        for (uint x = 0u; x < TILE_EDGE; ++x) line[x] = f4(red[x], green[x], blue[x], 1.0f);
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
        interpolate_smooth(&params, pixel_slot, irradiance, (uint)left, (uint)top, filtered);
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
        float4 mean = f4(0.0f, 0.0f, 0.0f, 0.0f);
        if (own > 1)
            mean = lattice_mean(&params, gb_ids, gb_albedo, gb_position, gb_shading, &surface,
                                pixel_slot, irradiance, x, y, own);
        // What the coarse lattice serves, the middle one may miss.
        if (own == 2 && mean.w == 0.0f)
            mean = lattice_mean(&params, gb_ids, gb_albedo, gb_position, gb_shading, &surface,
                                pixel_slot, irradiance, x, y, 4);
        if (mean.w == 0.0f)
            mean = window_mean(&params, gb_ids, gb_albedo, gb_position, gb_shading, &surface,
                               pixel_slot, irradiance, pixel);
        filtered[pixel] = mean;
    }
}
