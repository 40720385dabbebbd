// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Which pixels lie at an edge of the picture: one of the 8 neighbours shows another surface, or one
// of another colour. Texture makes no edge, since it is averaged over the pixel already. One
// work-item per tile, row by row.
#include "discontinuity.h"
#include "edges.h"
#include "geometry.h"

// Colours differ visibly where a channel differs by more than this share of the largest one.
#define VISIBLE_SHARE 0.01f

static inline int colours_differ(float3 a, float3 b) {
    float largest = m_max(max_component(a), max_component(b));
    return max_component(absolute3(a - b)) > VISIBLE_SHARE * largest ? 1 : 0;
}

/// 1 where `other` keeps to the plane and normal of `pixel`; both show surfaces.
static inline int continues(const Params* params, GLOBAL const float4* gb_position,
                            GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                            uint pixel, uint other) {
    PixelSurface surface = pixel_surface(params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
    return on_surface(&surface, gb_position, gb_shading, other);
}

/// 1 where an edge runs between two neighbours.
static inline int edge_between(const Params* params, GLOBAL const InstanceRecord* instances,
                               GLOBAL const uint* gb_ids, GLOBAL const float4* gb_position,
                               GLOBAL const float4* gb_normal, GLOBAL const float4* gb_shading,
                               GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_emission,
                               uint a, uint b) {
    uint instance_a = gb_ids[2u * a];
    uint instance_b = gb_ids[2u * b];
    if (gb_ids[2u * a + 1u] == gb_ids[2u * b + 1u] && instance_a == instance_b) return 0;
    if (instance_a == NO_TRIANGLE || instance_b == NO_TRIANGLE) return 1;
    if (colours_differ(xyz(gb_emission[a]), xyz(gb_emission[b])) != 0) return 1;
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

WEFT_KERNEL(edge_masks)
(PARAMS, GBUFFER_ARGS, GLOBAL const InstanceRecord* instances, GLOBAL uint* masks) {
    if (GLOBAL_ID >= params.count) return;
    uint tile = params.first + GLOBAL_ID;
    int width = (int)params.width;
    int height = (int)params.height;
    int left = (int)(tile % tile_columns(&params)) * TILE_EDGE;
    int top = (int)(tile / tile_columns(&params)) * TILE_EDGE;
    uint mask[2] = {0u, 0u};
    // Each pair of neighbours once: a pixel with those to the right and below it.
    for (int y = -1; y < TILE_EDGE; ++y) {
        for (int x = -1; x <= TILE_EDGE; ++x) {
            if (left + x < 0 || top + y < 0 || left + x >= width || top + y >= height) continue;
            for (int k = 0; k < 4; ++k) {
                int to_x = k == 3 ? x + 1 : x + k - 1;
                int to_y = k == 3 ? y : y + 1;
                if (left + to_x < 0 || left + to_x >= width || top + to_y >= height) continue;
                if (is_decided(mask, x, y) != 0 && is_decided(mask, to_x, to_y) != 0) continue;
                uint a = (uint)((top + y) * width + left + x);
                uint b = (uint)((top + to_y) * width + left + to_x);
                if (edge_between(&params, instances, gb_ids, gb_position, gb_normal, gb_shading,
                                 gb_albedo, gb_emission, a, b) == 0)
                    continue;
                set_tile_bit(mask, x, y);
                set_tile_bit(mask, to_x, to_y);
            }
        }
    }
    masks[2u * tile] = mask[0];
    masks[2u * tile + 1u] = mask[1];
}
