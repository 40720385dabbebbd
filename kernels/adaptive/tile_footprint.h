// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The surfaces of a tile of pixels and of those around it, laid out so that the discontinuity
// buffer filters a row of eight pixels at once. Results are those of discontinuity.h, bit for bit.
#ifndef WEFT_KERNELS_ADAPTIVE_TILE_FOOTPRINT_H
#define WEFT_KERNELS_ADAPTIVE_TILE_FOOTPRINT_H

#include "kernels/film/discontinuity.h"
#include "kernels/film/edges.h"

#define FOOTPRINT_EDGE (TILE_EDGE + 2)  // a tile and a border of one pixel
#define FOOTPRINT_ROW 12                // floats of a row; wide loads begin at column 0, 1 or 2

// Pixels that are not lit have the shading normal 0, and so lie on no pixel's surface.
typedef struct {
    float position[3][FOOTPRINT_EDGE][FOOTPRINT_ROW];
    float shading[3][FOOTPRINT_EDGE][FOOTPRINT_ROW];
    float normal[3][TILE_EDGE][TILE_EDGE];
    float reach[TILE_EDGE][TILE_EDGE];
    uint lit[2];  // of the tile's own pixels, as in TileRecord
} TileFootprint;

// Surfaces of a row of a tile's pixels.
typedef struct {
    NFloat x, y, z, normal_x, normal_y, normal_z, shading_x, shading_y, shading_z, reach;
} SurfaceRow;

/// Fills in the tile whose first pixel is (`left`, `top`), and `border` (0 or 1) pixels around it.
static inline void load_footprint(const RenderParams* params, GLOBAL const uint* gb_ids,
                                  GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                  GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                                  int left, int top, int border, TileFootprint* footprint) {
    footprint->lit[0] = 0u;
    footprint->lit[1] = 0u;
    for (int y = -border; y < TILE_EDGE + border; ++y) {
        for (int x = -border; x < TILE_EDGE + border; ++x) {
            int column = left + x;
            int row = top + y;
            int lit = 0;
            uint pixel = 0u;
            if (column >= 0 && row >= 0 && column < (int)params->camera.width &&
                row < (int)params->camera.height) {
                pixel = (uint)(row * (int)params->camera.width + column);
                lit = pixel_is_lit(gb_ids, gb_albedo, pixel);
            }
            float4 none = f4(0.0f, 0.0f, 0.0f, 0.0f);
            float4 position = lit != 0 ? gb_position[pixel] : none;
            float4 shading = lit != 0 ? gb_shading[pixel] : none;
            footprint->position[0][y + 1][x + 1] = position.x;
            footprint->position[1][y + 1][x + 1] = position.y;
            footprint->position[2][y + 1][x + 1] = position.z;
            footprint->shading[0][y + 1][x + 1] = shading.x;
            footprint->shading[1][y + 1][x + 1] = shading.y;
            footprint->shading[2][y + 1][x + 1] = shading.z;
            if (x < 0 || y < 0 || x >= TILE_EDGE || y >= TILE_EDGE) continue;
            float4 normal = lit != 0 ? gb_normal[pixel] : none;
            footprint->normal[0][y][x] = normal.x;
            footprint->normal[1][y][x] = normal.y;
            footprint->normal[2][y][x] = normal.z;
            footprint->reach[y][x] = params->filter.planes * normal.w;
            footprint->lit[y / 4] |= (uint)lit << (y % 4 * TILE_EDGE + x);
        }
    }
}

static inline SurfaceRow surface_row(const TileFootprint* footprint, uint y) {
    SurfaceRow row;
    row.x = node_load(&footprint->position[0][y + 1u][1]);
    row.y = node_load(&footprint->position[1][y + 1u][1]);
    row.z = node_load(&footprint->position[2][y + 1u][1]);
    row.shading_x = node_load(&footprint->shading[0][y + 1u][1]);
    row.shading_y = node_load(&footprint->shading[1][y + 1u][1]);
    row.shading_z = node_load(&footprint->shading[2][y + 1u][1]);
    row.normal_x = node_load(footprint->normal[0][y]);
    row.normal_y = node_load(footprint->normal[1][y]);
    row.normal_z = node_load(footprint->normal[2][y]);
    row.reach = node_load(footprint->reach[y]);
    return row;
}

/// Which pixels of a row have a point with that position and shading normal on their surface.
static inline NMask row_holds(const SurfaceRow* row, float3 position, float3 shading,
                              float cosine) {
    NFloat turn =
        row->shading_x * shading.x + row->shading_y * shading.y + row->shading_z * shading.z;
    NFloat distance = (position.x - row->x) * row->normal_x +
                      (position.y - row->y) * row->normal_y + (position.z - row->z) * row->normal_z;
    NFloat size = VMAX(distance, -distance);
    return (turn > NODE(cosine)) & (size < row->reach);
}

/// Which pixels of a row have the pixel (`dx`, `dy`) from them, each -1, 0 or 1, on their surface.
static inline NMask row_continues(const TileFootprint* footprint, const SurfaceRow* row, uint y,
                                  int dx, int dy, float cosine) {
    int v = (int)y + 1 + dy;
    int u = 1 + dx;
    NFloat turn = row->shading_x * node_load(&footprint->shading[0][v][u]) +
                  row->shading_y * node_load(&footprint->shading[1][v][u]) +
                  row->shading_z * node_load(&footprint->shading[2][v][u]);
    NFloat distance = (node_load(&footprint->position[0][v][u]) - row->x) * row->normal_x +
                      (node_load(&footprint->position[1][v][u]) - row->y) * row->normal_y +
                      (node_load(&footprint->position[2][v][u]) - row->z) * row->normal_z;
    NFloat size = VMAX(distance, -distance);
    return (turn > NODE(cosine)) & (size < row->reach);
}

/// Which pixels of a row lie on the surface.
static inline NMask row_lies_on(const SurfaceRow* row, const PixelSurface* surface) {
    NFloat turn = row->shading_x * surface->shading.x + row->shading_y * surface->shading.y +
                  row->shading_z * surface->shading.z;
    NFloat distance = (row->x - surface->position.x) * surface->normal.x +
                      (row->y - surface->position.y) * surface->normal.y +
                      (row->z - surface->position.z) * surface->normal.z;
    NFloat size = VMAX(distance, -distance);
    return (turn > NODE(surface->cosine)) & (size < NODE(surface->reach));
}

// Irradiance of a tile's pixels and of those around it that have samples; 0 elsewhere.
typedef struct {
    float red[FOOTPRINT_EDGE][FOOTPRINT_ROW];
    float green[FOOTPRINT_EDGE][FOOTPRINT_ROW];
    float blue[FOOTPRINT_EDGE][FOOTPRINT_ROW];
    float sampled[FOOTPRINT_EDGE][FOOTPRINT_ROW];  // 1 or 0
} TileSamples;

static inline void load_samples(const RenderParams* params, GLOBAL const uint* pixel_slot,
                                GLOBAL const float* irradiance, uint slots, int left, int top,
                                TileSamples* samples) {
    for (int y = -1; y <= TILE_EDGE; ++y) {
        for (int x = -1; x <= TILE_EDGE; ++x) {
            int column = left + x;
            int row = top + y;
            uint slot = INVALID_INDEX;
            if (column >= 0 && row >= 0 && column < (int)params->camera.width &&
                row < (int)params->camera.height)
                slot = pixel_slot[row * (int)params->camera.width + column];
            float3 e = f3(0.0f, 0.0f, 0.0f);
            if (slot != INVALID_INDEX) e = slot_irradiance(irradiance, slots, slot);
            samples->red[y + 1][x + 1] = e.x;
            samples->green[y + 1][x + 1] = e.y;
            samples->blue[y + 1][x + 1] = e.z;
            samples->sampled[y + 1][x + 1] = slot != INVALID_INDEX ? 1.0f : 0.0f;
        }
    }
}

// Irradiance of a tile's pixels: rgb, and the sum of the weights that it is a mean by.
typedef struct {
    float red[TILE_EDGE][TILE_EDGE];
    float green[TILE_EDGE][TILE_EDGE];
    float blue[TILE_EDGE][TILE_EDGE];
    float weight[TILE_EDGE][TILE_EDGE];
} TileMeans;

typedef struct {
    NFloat red, green, blue, weight;
} MeanRow;

static inline MeanRow no_means(void) {
    MeanRow row;
    row.red = NODE(0.0f);
    row.green = NODE(0.0f);
    row.blue = NODE(0.0f);
    row.weight = NODE(0.0f);
    return row;
}

static inline void add_means(MeanRow* row, NMask mask, NFloat red, NFloat green, NFloat blue,
                             NFloat weight) {
    NFloat zero = NODE(0.0f);
    row->red = row->red + SELECT(mask, red, zero);
    row->green = row->green + SELECT(mask, green, zero);
    row->blue = row->blue + SELECT(mask, blue, zero);
    row->weight = row->weight + SELECT(mask, weight, zero);
}

/// Divides by the weight; 0 where there is none.
static inline void store_means(const MeanRow* row, uint y, TileMeans* means) {
    NFloat zero = NODE(0.0f);
    NFloat share = SELECT(row->weight > zero, NODE(1.0f) / row->weight, zero);
    node_store(row->red * share, means->red[y]);
    node_store(row->green * share, means->green[y]);
    node_store(row->blue * share, means->blue[y]);
    node_store(row->weight, means->weight[y]);
}

static inline float4 mean_of(const TileMeans* means, uint bit) {
    uint x = bit % TILE_EDGE;
    uint y = bit / TILE_EDGE;
    return f4(means->red[y][x], means->green[y][x], means->blue[y][x], means->weight[y][x]);
}

/// 1 where a pixel's filter footprint is 3 x 3 pixels and lies inside the image without being
/// moved.
static inline int footprint_is_centred(const RenderParams* params, int x, int y) {
    return params->filter.radius == 1u && x > 0 && y > 0 && x + 1 < (int)params->camera.width &&
                   y + 1 < (int)params->camera.height
               ? 1
               : 0;
}

/// The discontinuity buffer of a tile, for filter footprints of 3 x 3 pixels: footprint_mean of all
/// its pixels but those at the image's border, whose footprints are moved inwards.
static inline void footprint_means(const RenderParams* params, const TileFootprint* footprint,
                                   const TileSamples* samples, TileMeans* means) {
    for (uint y = 0u; y < TILE_EDGE; ++y) {
        SurfaceRow row = surface_row(footprint, y);
        MeanRow sum = no_means();
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                NMask mask = row_continues(footprint, &row, y, dx, dy, params->filter.cosine);
                // A pixel is on its own surface whatever rounding says.
                if (dx == 0 && dy == 0) mask = NODE(0.0f) == NODE(0.0f);
                int v = (int)y + 1 + dy;
                int u = 1 + dx;
                add_means(&sum, mask, node_load(&samples->red[v][u]),
                          node_load(&samples->green[v][u]), node_load(&samples->blue[v][u]),
                          node_load(&samples->sampled[v][u]));
            }
        }
        store_means(&sum, y, means);
    }
}

#endif
