// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What the samples in and close to a tile say of each group of lights, and of the groups that all
// of them see whether nothing at all can lie between the tile and the lights (shaft.h). One
// work-item per tile.
#include "discontinuity.h"
#include "shadow_groups.h"
#include "shaft.h"

// Receivers of a tile, its pixels and those that they share samples with, are parted by the plane
// that they lie in, because nothing on that plane can block them; at most so many planes.
#define RECEIVER_PARTS 4u
// Planes are one where normals differ by less than this squared, and offsets by less than this
// share of the extent, which SHAFT_PLANE_REACH covers.
#define SAME_NORMAL 1.0e-12f
#define SAME_PLANE 2.3841858e-7f  // 2^-22

typedef struct {
    float3 low, high;
    float4 plane;  // of the first receiver: unit normal, offset
} ReceiverPart;

typedef struct {
    ReceiverPart parts[RECEIVER_PARTS];
    uint count;
    int complete;  // 0 where there are more planes
} ReceiverParts;

static inline void add_receiver(const Params* params, ReceiverParts* parts, float3 position,
                                float3 normal) {
    float offset = dot3(position, normal);
    for (uint i = 0u; i < parts->count; ++i) {
        ReceiverPart* part = &parts->parts[i];
        float3 turn = normal - xyz(part->plane);
        float4 plane = part->plane;
        float gap = absolute(dot3(position, xyz(plane)) - plane.w);
        if (!(dot3(turn, turn) < SAME_NORMAL && gap < SAME_PLANE * params->extent)) continue;
        part->low = lowest3(part->low, position);
        part->high = highest3(part->high, position);
        return;
    }
    if (parts->count == RECEIVER_PARTS) {
        parts->complete = 0;
        return;
    }
    ReceiverPart* part = &parts->parts[parts->count++];
    part->low = position;
    part->high = position;
    part->plane = f4(normal.x, normal.y, normal.z, offset);
}

/// All lit pixels of a tile and of the windows about its pixels: where a shadow in the next tile
/// reaches this one through the discontinuity buffer, this one is not open.
static inline void add_receivers(const Params* params, GLOBAL const uint* gb_ids,
                                 GLOBAL const float4* gb_albedo, GLOBAL const float4* gb_position,
                                 GLOBAL const float4* gb_normal, int left, int top,
                                 ReceiverParts* parts) {
    int width = (int)params->width;
    int height = (int)params->height;
    int radius = (int)params->filter_radius;
    int right = left + TILE_EDGE < width ? left + TILE_EDGE - 1 : width - 1;
    int bottom = top + TILE_EDGE < height ? top + TILE_EDGE - 1 : height - 1;
    int x1 = window_start(right, radius, width) + 2 * radius;
    int y1 = window_start(bottom, radius, height) + 2 * radius;
    for (int y = window_start(top, radius, height); y <= y1 && y < height; ++y) {
        for (int x = window_start(left, radius, width); x <= x1 && x < width; ++x) {
            uint pixel = (uint)(y * width + x);
            if (pixel_is_lit(gb_ids, gb_albedo, pixel) == 0) continue;
            add_receiver(params, parts, xyz(gb_position[pixel]), xyz(gb_normal[pixel]));
        }
    }
}

/// 1 where the shafts from every part to every light of the group are proven to be open.
static inline int group_is_open(Scene scene, const Params* params, const ReceiverParts* parts,
                                GLOBAL const float4* light_boxes, uint group) {
    uint end = shadow_group_light(params, group + 1u);
    for (uint light = shadow_group_light(params, group); light < end; ++light) {
        GLOBAL const float4* box = light_boxes + 3u * light;
        for (uint i = 0u; i < parts->count; ++i) {
            const ReceiverPart* part = &parts->parts[i];
            Shaft shaft;
            if (make_shaft(part->low, part->high, xyz(box[0]), xyz(box[1]), part->plane, box[2],
                           params->extent, &shaft) == 0)
                return 0;
            if (shaft_is_open(scene, &shaft) == 0) return 0;
        }
    }
    return 1;
}

/// Adds what the sample of a slot, if it is one, saw of each group.
static inline void add_sample(const Params* params, uint slot, GLOBAL const uint* packet_shadows,
                              TileShadows* shadows) {
    if (slot == NO_TRIANGLE) return;
    GLOBAL const uint* words = packet_shadows + slot / (uint)LANES * SHADOW_GROUPS;
    uint lane = slot % (uint)LANES;
    for (uint group = 0u; group < params->shadow_groups; ++group) {
        uint seen = words[group] >> lane & 1u;
        uint hidden = words[group] >> (lane + 16u) & 1u;
        shadows->seen |= seen << group;
        shadows->hidden |= hidden << group;
        shadows->plain |= (seen ^ hidden) << group;
    }
}

WEFT_KERNEL(tile_shadows)
(PARAMS, SCENE_ARGS, GBUFFER_ARGS, GLOBAL const TileRecord* tiles, GLOBAL const uint* pixel_slot,
 GLOBAL const uint* packet_shadows, GLOBAL const float4* light_boxes,
 GLOBAL TileShadows* tile_shadows) {
    if (GLOBAL_ID >= params.count) return;
    uint tile = params.first + GLOBAL_ID;
    TileRecord record = tiles[tile];
    TileShadows shadows;
    shadows.seen = 0u;
    shadows.hidden = 0u;
    shadows.open = 0u;
    shadows.plain = 0u;
    SCENE_MAKE(scene);
    uint columns = (params.width + TILE_EDGE - 1u) / TILE_EDGE;
    uint left = tile % columns * TILE_EDGE;
    uint top = tile / columns * TILE_EDGE;
    ReceiverParts parts;
    parts.count = 0u;
    parts.complete = 1;
    add_receivers(&params, gb_ids, gb_albedo, gb_position, gb_normal, (int)left, (int)top, &parts);
    for (uint bit = 0u; bit < 64u; ++bit) {
        if ((record.lit[bit / 32u] >> (bit % 32u) & 1u) == 0u) continue;
        add_sample(&params,
                   pixel_slot[(top + bit / TILE_EDGE) * params.width + left + bit % TILE_EDGE],
                   packet_shadows, &shadows);
    }
    // The lattice points that the tile's pixels are interpolated from lie around it.
    for (int j = -1; j <= 2; ++j) {
        for (int i = -1; i <= 2; ++i) {
            int x = (int)left + 4 * i;
            int y = (int)top + 4 * j;
            if (x < 0 || y < 0 || x >= (int)params.width || y >= (int)params.height) continue;
            add_sample(&params, pixel_slot[y * (int)params.width + x], packet_shadows, &shadows);
        }
    }
    // Where lights are chosen by power there may be thousands, and any sample may be of any.
    if (parts.complete != 0 && params.samples_per_light > 0u) {
        for (uint group = 0u; group < params.shadow_groups; ++group) {
            if ((shadows.seen & ~shadows.hidden & 1u << group) == 0u) continue;
            if (group_is_open(scene, &params, &parts, light_boxes, group) != 0)
                shadows.open |= 1u << group;
        }
    }
    tile_shadows[tile] = shadows;
}
