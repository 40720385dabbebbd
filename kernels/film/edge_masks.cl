// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the pixels at edges within the image: those of whose 8 neighbours one shows another
// surface, or one of another colour. Texture makes no edge, since it is averaged over the pixel
// already. One work-item per tile, row by row.
#include "kernels/bvh/geometry.h"
#include "kernels/core/kernel.h"
#include "kernels/film/discontinuity.h"
#include "kernels/film/edges.h"

// Colours differ visibly where a channel differs by more than this share of the largest one.
#define VISIBLE_SHARE 0.01f

static inline int colours_differ(float3 a, float3 b) {
    float largest = m_max(max_component(a), max_component(b));
    return max_component(absolute3(a - b)) > VISIBLE_SHARE * largest ? 1 : 0;
}

/// 1 where `other` keeps to the plane and normal of `pixel`; both show surfaces.
static inline int continues(const RenderParams* params, GLOBAL const float4* gb_position,
                            GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                            uint pixel, uint other) {
    PixelSurface surface = pixel_surface(params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
    return on_surface(&surface, gb_position, gb_shading, other);
}

/// 1 where an edge runs between two neighbours.
static inline int edge_between(const RenderParams* params, GLOBAL const InstanceRecord* instances,
                               GLOBAL const uint* gb_ids, GLOBAL const float4* gb_position,
                               GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                               GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_emission,
                               uint a, uint b) {
    uint instance_a = gb_ids[2u * a];
    uint instance_b = gb_ids[2u * b];
    if (gb_ids[2u * a + 1u] == gb_ids[2u * b + 1u] && instance_a == instance_b) return 0;
    if (instance_a == INVALID_INDEX || instance_b == INVALID_INDEX) return 1;
    // Of one instance a texture may make the difference, and the side is told by the normals.
    int textured = HAS(params, FEATURE_EMISSION_TEXTURES) && instance_a == instance_b ? 1 : 0;
    if (textured == 0 && colours_differ(xyz(gb_emission[a]), xyz(gb_emission[b])) != 0) return 1;
    if (pixel_is_lit(gb_ids, gb_albedo, a) == 0 && pixel_is_lit(gb_ids, gb_albedo, b) == 0)
        return 0;
    if (continues(params, gb_position, gb_normal, gb_shading, a, b) == 0) return 1;
    if (continues(params, gb_position, gb_normal, gb_shading, b, a) == 0) return 1;
    if (instance_a == instance_b) return 0;
    if (instances[instance_a].material == instances[instance_b].material) return 0;
    return colours_differ(xyz(gb_albedo[a]), xyz(gb_albedo[b]));
}

/// Sets the bit of a pixel (`x`, `y`) relative to the tile where it lies in it; else nothing.
static inline void set_tile_bit(uint* mask, int x, int y) {
    if (x < 0 || y < 0 || x >= TILE_EDGE || y >= TILE_EDGE) return;
    int bit = y * TILE_EDGE + x;
    mask[bit / 32] |= 1u << (bit % 32);
}

/// 1 where the pixel (`x`, `y`) relative to the tile lies outside of it or has its bit.
static inline int is_decided(const uint* mask, int x, int y) {
    if (x < 0 || y < 0 || x >= TILE_EDGE || y >= TILE_EDGE) return 1;
    int bit = y * TILE_EDGE + x;
    return (int)(mask[bit / 32] >> (bit % 32) & 1u);
}

#define RIM_EDGE (TILE_EDGE + 2)  // a tile and the pixels about it

// Triangles that these pixels show, and the range of those inside the image.
typedef struct {
    uint triangles[RIM_EDGE][RIM_EDGE];
    int first_x, first_y, end_x, end_y;  // relative to the tile
} TileTriangles;

static inline void load_triangles(const RenderParams* params, GLOBAL const uint* gb_ids, int left,
                                  int top, TileTriangles* tile) {
    int width = (int)params->camera.width;
    int height = (int)params->camera.height;
    tile->first_x = left > 0 ? -1 : 0;
    tile->first_y = top > 0 ? -1 : 0;
    tile->end_x = width - left < TILE_EDGE + 1 ? width - left : TILE_EDGE + 1;
    tile->end_y = height - top < TILE_EDGE + 1 ? height - top : TILE_EDGE + 1;
    for (int y = tile->first_y; y < tile->end_y; ++y) {
        GLOBAL const uint* row = gb_ids + 2 * ((top + y) * width + left);
        for (int x = tile->first_x; x < tile->end_x; ++x)
            tile->triangles[y + 1][x + 1] = row[2 * x + 1];
    }
}

/// Pixels of a row, from column -1 on, that show another triangle than the one (`dx`, `dy`) from
/// them, both inside of the image; a bit each.
static inline uint row_differs(const TileTriangles* tile, int y, int dx, int dy) {
    if (y + dy >= tile->end_y) return 0u;
    const uint* row = tile->triangles[y + 1];
    const uint* other = tile->triangles[y + 1 + dy];
    uint bits = 0u;
    for (int x = tile->first_x; x < tile->end_x; ++x) {
        int to = x + dx;
        if (to < tile->first_x || to >= tile->end_x) continue;
        bits |= (row[x + 1] != other[to + 1] ? 1u : 0u) << (x + 1);
    }
    return bits;
}

WEFT_KERNEL(edge_masks)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint tile = range.first + WORK_ITEM(range);
    int width = (int)params.camera.width;
    int left = (int)(tile % tile_columns(&params)) * TILE_EDGE;
    int top = (int)(tile / tile_columns(&params)) * TILE_EDGE;
    TileTriangles triangles;
    load_triangles(&params, gb_ids, left, top, &triangles);
    uint mask[2] = {0u, 0u};
    // Each pair of neighbours once: a pixel with those to the right and below it. Those of one
    // triangle have no edge between them.
    for (int y = triangles.first_y; y < TILE_EDGE && y < triangles.end_y; ++y) {
        for (int k = 0; k < 4; ++k) {
            int dx = k == 3 ? 1 : k - 1;
            int dy = k == 3 ? 0 : 1;
            uint pairs = row_differs(&triangles, y, dx, dy);
            while (pairs != 0u) {
                int x = (int)lowest_bit(pairs) - 1;
                pairs &= pairs - 1u;
                if (is_decided(mask, x, y) != 0 && is_decided(mask, x + dx, y + dy) != 0) continue;
                uint a = (uint)((top + y) * width + left + x);
                uint b = (uint)((top + y + dy) * width + left + x + dx);
                if (edge_between(&params, instances, gb_ids, gb_position, gb_normal, gb_shading,
                                 gb_albedo, gb_emission, a, b) == 0)
                    continue;
                set_tile_bit(mask, x, y);
                set_tile_bit(mask, x + dx, y + dy);
            }
        }
    }
    masks[2u * tile] = mask[0];
    masks[2u * tile + 1u] = mask[1];
}
