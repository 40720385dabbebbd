// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What the G-buffer says about undersampling a tile: which pixels are lit, and how coarse a lattice
// serves each. A pixel is served by a lattice if the taps that lie on its own surface hold most of
// the weight. One work-item per tile, row by row.
#include "discontinuity.h"
#include "lattice.h"

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

// The pixels of a tile, a row of eight at once. Pixels that are not lit reach nowhere.
typedef struct {
    NFloat x, y, z, normal_x, normal_y, normal_z, shading_x, shading_y, shading_z, reach;
} SurfaceRow;

typedef struct {
    SurfaceRow rows[TILE_EDGE];
    uint lit[2];
} TileSurfaces;

static inline void load_row(const Params* params, GLOBAL const uint* gb_ids,
                            GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                            GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                            uint first, uint count, SurfaceRow* row, uint* lit) {
    float values[10][TILE_EDGE];
    *lit = 0u;
    for (uint x = 0u; x < TILE_EDGE; ++x) {
        for (uint k = 0u; k < 10u; ++k) values[k][x] = 0.0f;
        if (x >= count || pixel_is_lit(gb_ids, gb_albedo, first + x) == 0) continue;
        *lit |= 1u << x;
        float4 position = gb_position[first + x];
        float4 normal = gb_normal[first + x];
        float4 shading = gb_shading[first + x];
        values[0][x] = position.x;
        values[1][x] = position.y;
        values[2][x] = position.z;
        values[3][x] = normal.x;
        values[4][x] = normal.y;
        values[5][x] = normal.z;
        values[6][x] = shading.x;
        values[7][x] = shading.y;
        values[8][x] = shading.z;
        values[9][x] = params->filter_planes * normal.w;
    }
    row->x = node_load(values[0]);
    row->y = node_load(values[1]);
    row->z = node_load(values[2]);
    row->normal_x = node_load(values[3]);
    row->normal_y = node_load(values[4]);
    row->normal_z = node_load(values[5]);
    row->shading_x = node_load(values[6]);
    row->shading_y = node_load(values[7]);
    row->shading_z = node_load(values[8]);
    row->reach = node_load(values[9]);
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

/// 1 where the taps of a tile keep to the lattice points around it.
static inline int tile_is_inside(const Params* params, int left, int top) {
    return left >= 4 && top >= 4 && left + 16 <= (int)params->width &&
                   top + 16 <= (int)params->height
               ? 1
               : 0;
}

/// 1 where all pixels of a tile, all lit, and all coarse lattice points about it are one smooth
/// surface.
static inline int tile_is_smooth(const Params* params, GLOBAL const uint* gb_ids,
                                 GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                 GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                                 const TileSurfaces* surfaces, int left, int top) {
    int width = (int)params->width;
    uint centre = (uint)((top + 4) * width + left + 4);
    PixelSurface surface =
        pixel_surface(params, gb_position, gb_normal, gb_shading, centre, SMOOTH_SHARE);
    for (uint y = 0u; y < TILE_EDGE; ++y)
        if (node_mask_bits(row_lies_on(&surfaces->rows[y], &surface)) != 0xFFu) return 0;
    for (int y = top - 4; y <= top + 12; y += 4) {
        for (int x = left - 4; x <= left + 12; x += 4) {
            uint other = (uint)(y * width + x);
            if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) return 0;
            if (on_surface(&surface, gb_position, gb_shading, other) == 0) return 0;
        }
    }
    return 1;
}

/// Pixels of a tile inside the picture that the lattice serves, as two words.
static inline void served_inside(const Params* params, GLOBAL const uint* gb_ids,
                                 GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                 GLOBAL const float4* gb_shading, const TileSurfaces* surfaces,
                                 int left, int top, int stride, uint points,
                                 CONSTANT_POINTER float* weights, uint* served) {
    NFloat support[TILE_EDGE];
    for (uint y = 0u; y < TILE_EDGE; ++y) support[y] = NODE(0.0f);
    for (uint j = 0u; j < points; ++j) {
        for (uint i = 0u; i < points; ++i) {
            int x = left + ((int)i - 1) * stride;
            int y = top + ((int)j - 1) * stride;
            uint other = (uint)(y * (int)params->width + x);
            if (pixel_is_lit(gb_ids, gb_albedo, other) == 0) continue;
            float3 position = xyz(gb_position[other]);
            float3 shading = xyz(gb_shading[other]);
            NFloat across = node_load(weights + TILE_EDGE * i);
            for (uint row = 0u; row < TILE_EDGE; ++row) {
                float down = weights[TILE_EDGE * j + row];
                if (down == 0.0f) continue;
                NMask holds =
                    row_holds(&surfaces->rows[row], position, shading, params->filter_cosine);
                support[row] = support[row] + SELECT(holds, across * down, NODE(0.0f));
            }
        }
    }
    served[0] = 0u;
    served[1] = 0u;
    for (uint row = 0u; row < TILE_EDGE; ++row)
        served[row / 4u] |= node_mask_bits(support[row] >= NODE(params->enough_support))
                            << (row % 4u * TILE_EDGE);
}

/// The same for any tile, pixel by pixel.
static inline void served_at_border(const Params* params, GLOBAL const uint* gb_ids,
                                    GLOBAL const float4* gb_albedo,
                                    GLOBAL const float4* gb_position,
                                    GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                                    const TileSurfaces* surfaces, int left, int top, int stride,
                                    uint* served) {
    served[0] = 0u;
    served[1] = 0u;
    for (uint bit = 0u; bit < 64u; ++bit) {
        if ((surfaces->lit[bit / 32u] >> (bit % 32u) & 1u) == 0u) continue;
        int x = left + (int)(bit % TILE_EDGE);
        int y = top + (int)(bit / TILE_EDGE);
        PixelSurface surface = pixel_surface(params, gb_position, gb_normal, gb_shading,
                                             (uint)(y * (int)params->width + x), 1.0f);
        if (lattice_support(params, gb_ids, gb_albedo, gb_position, gb_shading, &surface, x, y,
                            stride) >= params->enough_support)
            served[bit / 32u] |= 1u << (bit % 32u);
    }
}

WEFT_KERNEL(tile_geometry)
(PARAMS, GBUFFER_ARGS, GLOBAL TileRecord* tiles) {
    if (GLOBAL_ID >= params.count) return;
    uint tile = params.first + GLOBAL_ID;
    uint columns = (params.width + TILE_EDGE - 1u) / TILE_EDGE;
    int left = (int)(tile % columns) * TILE_EDGE;
    int top = (int)(tile / columns) * TILE_EDGE;
    TileSurfaces surfaces;
    surfaces.lit[0] = 0u;
    surfaces.lit[1] = 0u;
    uint width = params.width - (uint)left;
    for (uint y = 0u; y < TILE_EDGE; ++y) {
        uint row = (uint)top + y;
        uint lit;
        load_row(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading,
                 row * params.width + (uint)left, row < params.height ? width : 0u,
                 &surfaces.rows[y], &lit);
        surfaces.lit[y / 4u] |= lit << (y % 4u * TILE_EDGE);
    }
    TileRecord record;
    record.flags = 0u;
    record.pad = 0u;
    int inside = tile_is_inside(&params, left, top);
    int all = (surfaces.lit[0] & surfaces.lit[1]) == 0xFFFFFFFFu ? 1 : 0;
    if (inside != 0 && all != 0 &&
        tile_is_smooth(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, &surfaces,
                       left, top) != 0)
        record.flags = TILE_SMOOTH;
    uint coarse[2] = {0xFFFFFFFFu, 0xFFFFFFFFu};
    uint middle[2] = {0xFFFFFFFFu, 0xFFFFFFFFu};
    if (record.flags == 0u && inside != 0) {
        served_inside(&params, gb_ids, gb_albedo, gb_position, gb_shading, &surfaces, left, top, 4,
                      TILE_POINTS_4, tile_weights_4, coarse);
        if (((surfaces.lit[0] & ~coarse[0]) | (surfaces.lit[1] & ~coarse[1])) != 0u)
            served_inside(&params, gb_ids, gb_albedo, gb_position, gb_shading, &surfaces, left, top,
                          2, TILE_POINTS_2, tile_weights_2, middle);
    } else if (record.flags == 0u) {
        served_at_border(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, &surfaces,
                         left, top, 4, coarse);
        served_at_border(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading, &surfaces,
                         left, top, 2, middle);
    }
    for (uint word = 0u; word < 2u; ++word) {
        record.lit[word] = surfaces.lit[word];
        record.middle[word] = surfaces.lit[word] & ~coarse[word] & middle[word];
        record.fine[word] = surfaces.lit[word] & ~coarse[word] & ~middle[word];
    }
    tiles[tile] = record;
}
