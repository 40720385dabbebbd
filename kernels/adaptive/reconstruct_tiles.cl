// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Reconstructs the irradiance of every pixel of undersampled tiles, by interpolation between
// lattice points. `tile_height` holds each tile's level: 0, 1 and 2 for lattices of stride 4, 2 and
// 1. A tile that fades from one level to another has one in between, whose fraction is the share of
// the finer lattice. Pixels that need a finer lattice, by tile_geometry, use it. At stride 1 this
// is the discontinuity buffer of reconstruct.cl. One work-item per tile.
#include "kernels/adaptive/lattice.h"
#include "kernels/adaptive/tile_footprint.h"
#include "kernels/core/kernel.h"

/// Interpolates at a lit pixel of any tile: taps on other surfaces are left out.
static inline float4 lattice_mean(const RenderParams* params, GLOBAL const uint* gb_ids,
                                  GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                  GLOBAL const float4* gb_shading, const PixelSurface* surface,
                                  GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance,
                                  uint slots, int x, int y, int stride) {
    int width = (int)params->camera.width;
    int height = (int)params->camera.height;
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
            if (slot == INVALID_INDEX) continue;
            if (on_surface(surface, gb_position, gb_shading, other) == 0) continue;
            sum += slot_irradiance(irradiance, slots, slot) * share;
            weight += share;
        }
    }
    float share = weight > 0.0f ? 1.0f / weight : 0.0f;
    return f4(sum.x * share, sum.y * share, sum.z * share, weight);
}

typedef struct {
    NFloat red, green, blue;  // of a row of pixels
} PixelRow;

/// Interpolates a row of a tile's pixels between the coarse lattice points of a row, from `pixel`
/// on.
static inline PixelRow smooth_row(GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance,
                                  uint slots, uint pixel) {
    PixelRow row = {NODE(0.0f), NODE(0.0f), NODE(0.0f)};
    for (uint i = 0u; i < TILE_POINTS_4; ++i) {
        float3 point = slot_irradiance(irradiance, slots, pixel_slot[pixel + 4u * i]);
        NFloat weight = node_load(tile_weights_4 + TILE_EDGE * i);
        row.red = row.red + weight * point.x;
        row.green = row.green + weight * point.y;
        row.blue = row.blue + weight * point.z;
    }
    return row;
}

/// Interpolates a smooth tile (TILE_SMOOTH) at stride 4: all its taps lie on its surface, so that
/// none needs a test.
static inline void interpolate_smooth(const RenderParams* params, GLOBAL const uint* pixel_slot,
                                      GLOBAL const float* irradiance, uint slots, uint left,
                                      uint top, GLOBAL float4* filtered) {
    PixelRow rows[TILE_POINTS_4];
    for (uint j = 0u; j < TILE_POINTS_4; ++j)
        rows[j] = smooth_row(pixel_slot, irradiance, slots,
                             (top + 4u * j - 4u) * params->camera.width + left - 4u);
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
        GLOBAL float4* line = filtered + (top + y) * params->camera.width + left;
        for (uint x = 0u; x < TILE_EDGE; ++x) line[x] = f4(red[x], green[x], blue[x], 1.0f);
    }
}

/// Interpolates all pixels of a tile inside the image as lattice_mean does. The tile has `points`
/// lattice points along an edge, the first of which lies one stride before it.
static inline void lattice_means(const RenderParams* params, GLOBAL const uint* gb_ids,
                                 GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                 GLOBAL const float4* gb_shading, const TileFootprint* footprint,
                                 GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance,
                                 uint slots, int left, int top, int stride, uint points,
                                 CONSTANT_POINTER float* weights, TileMeans* means) {
    SurfaceRow rows[TILE_EDGE];
    MeanRow sums[TILE_EDGE];
    for (uint y = 0u; y < TILE_EDGE; ++y) {
        rows[y] = surface_row(footprint, y);
        sums[y] = no_means();
    }
    for (uint j = 0u; j < points; ++j) {
        for (uint i = 0u; i < points; ++i) {
            int x = left + ((int)i - 1) * stride;
            int y = top + ((int)j - 1) * stride;
            uint other = (uint)(y * (int)params->camera.width + x);
            uint slot = pixel_slot[other];
            if (slot == INVALID_INDEX || pixel_is_lit(gb_ids, gb_albedo, other) == 0) continue;
            float3 e = slot_irradiance(irradiance, slots, slot);
            float3 position = xyz(gb_position[other]);
            float3 shading = xyz(gb_shading[other]);
            NFloat across = node_load(weights + TILE_EDGE * i);
            for (uint row = 0u; row < TILE_EDGE; ++row) {
                float down = weights[TILE_EDGE * j + row];
                if (down == 0.0f) continue;
                NMask holds = row_holds(&rows[row], position, shading, params->filter.cosine);
                NFloat share = across * down;
                add_means(&sums[row], holds, share * e.x, share * e.y, share * e.z, share);
            }
        }
    }
    for (uint y = 0u; y < TILE_EDGE; ++y) store_means(&sums[y], y, means);
}

// Pixels of a tile by the lattice that they are interpolated from, as in TileRecord.
typedef struct {
    uint coarse[2], middle[2], full[2];
} TileStrides;

static inline TileStrides tile_strides(const TileRecord* record, uint stride) {
    TileStrides strides;
    for (uint word = 0u; word < 2u; ++word) {
        uint lit = record->lit[word];
        uint fine = stride == 1u ? lit : record->fine[word];
        uint middle = stride == 2u ? lit : record->middle[word];
        strides.full[word] = fine;
        strides.middle[word] = middle & ~fine;
        strides.coarse[word] = lit & ~middle & ~fine;
    }
    return strides;
}

/// Irradiance of one pixel where the computation for the whole tile has none: at the image's
/// border, or where no tap lies on its surface.
static inline float4 pixel_mean(const RenderParams* params, GLOBAL const uint* gb_ids,
                                GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                                GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance,
                                uint slots, int x, int y, int stride) {
    uint pixel = (uint)(y * (int)params->camera.width + x);
    PixelSurface surface = pixel_surface(params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
    float4 mean = f4(0.0f, 0.0f, 0.0f, 0.0f);
    // A pixel without a tap on the middle lattice may have one on the coarse lattice.
    for (int s = stride; s > 1 && s <= 4 && mean.w == 0.0f; s *= 2)
        mean = lattice_mean(params, gb_ids, gb_albedo, gb_position, gb_shading, &surface,
                            pixel_slot, irradiance, slots, x, y, s);
    if (mean.w == 0.0f)
        mean = footprint_mean(params, gb_ids, gb_albedo, gb_position, gb_shading, &surface,
                              pixel_slot, irradiance, slots, pixel);
    return mean;
}

/// Reconstructs all pixels of a tile that is sampled at stride `tile_stride`. A `share` below 1
/// blends the result into what `filtered` holds; a share of 1 replaces it.
static inline void reconstruct_at(const RenderParams* params, GLOBAL const uint* gb_ids,
                                  GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                  GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                                  const TileRecord* record, const TileFootprint* footprint,
                                  GLOBAL const uint* pixel_slot, GLOBAL const float* irradiance,
                                  uint slots, int left, int top, uint tile_stride, float share,
                                  GLOBAL float4* filtered) {
    TileStrides strides = tile_strides(record, tile_stride);
    int inside = tile_is_inside(params, left, top);
    TileMeans coarse, middle, full;
    if (inside != 0 && (strides.coarse[0] | strides.coarse[1]) != 0u)
        lattice_means(params, gb_ids, gb_albedo, gb_position, gb_shading, footprint, pixel_slot,
                      irradiance, slots, left, top, 4, TILE_POINTS_4, tile_weights_4, &coarse);
    if (inside != 0 && (strides.middle[0] | strides.middle[1]) != 0u)
        lattice_means(params, gb_ids, gb_albedo, gb_position, gb_shading, footprint, pixel_slot,
                      irradiance, slots, left, top, 2, TILE_POINTS_2, tile_weights_2, &middle);
    if ((strides.full[0] | strides.full[1]) != 0u && params->filter.radius == 1u) {
        TileSamples samples;
        load_samples(params, pixel_slot, irradiance, slots, left, top, &samples);
        footprint_means(params, footprint, &samples, &full);
    }
    for (uint bit = 0u; bit < TILE_EDGE * TILE_EDGE; ++bit) {
        int x = left + (int)(bit % TILE_EDGE);
        int y = top + (int)(bit / TILE_EDGE);
        if (x >= (int)params->camera.width || y >= (int)params->camera.height) continue;
        uint word = bit / 32u;
        uint mask = 1u << (bit % 32u);
        float4 mean = f4(0.0f, 0.0f, 0.0f, 0.0f);
        int stride = 0;
        if ((strides.coarse[word] & mask) != 0u) {
            stride = 4;
            if (inside != 0) mean = mean_of(&coarse, bit);
        } else if ((strides.middle[word] & mask) != 0u) {
            stride = 2;
            if (inside != 0) mean = mean_of(&middle, bit);
        } else if ((strides.full[word] & mask) != 0u) {
            stride = 1;
            if (footprint_is_centred(params, x, y) != 0) mean = mean_of(&full, bit);
        }
        if (stride != 0 && mean.w == 0.0f)
            mean = pixel_mean(params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading,
                              pixel_slot, irradiance, slots, x, y, stride);
        uint pixel = (uint)(y * (int)params->camera.width + x);
        if (share < 1.0f) {
            float3 coarser = xyz(filtered[pixel]);
            float3 mixed = coarser + (xyz(mean) - coarser) * share;
            mean = f4(mixed.x, mixed.y, mixed.z, mean.w);
        }
        filtered[pixel] = mean;
    }
}

WEFT_KERNEL(reconstruct_tiles)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint tile = range.first + WORK_ITEM(range);
    TileRecord record = tiles[tile];
    int left = (int)(tile % tile_columns(&params)) * TILE_EDGE;
    int top = (int)(tile / tile_columns(&params)) * TILE_EDGE;
    uint level = (uint)tile_height[tile];
    float finer_share = tile_height[tile] - (float)level;
    int smooth = level == 0u && (record.flags & TILE_SMOOTH) != 0u ? 1 : 0;
    if (smooth != 0)
        interpolate_smooth(&params, pixel_slot, irradiance, slots, (uint)left, (uint)top, filtered);
    if (smooth != 0 && finer_share == 0.0f) return;
    TileFootprint footprint;
    if ((record.lit[0] | record.lit[1]) != 0u)
        load_footprint(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, left, top, 1,
                       &footprint);
    if (smooth == 0)
        reconstruct_at(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, &record,
                       &footprint, pixel_slot, irradiance, slots, left, top, 4u >> level, 1.0f,
                       filtered);
    if (finer_share > 0.0f)
        reconstruct_at(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, &record,
                       &footprint, pixel_slot, irradiance, slots, left, top, 2u >> level,
                       finer_share, filtered);
}
