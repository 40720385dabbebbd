// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What the samples of a tile say of each group of lights, and of the groups that all of them see
// whether nothing at all can lie between the tile and the lights (shaft.h). One work-item per tile.
#include "discontinuity.h"
#include "shadow_groups.h"
#include "shaft.h"

// Receivers of a tile are parted by the plane that they lie in, because nothing on that plane can
// block them; at most so many planes.
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
    shadows.pad = 0u;
    SCENE_MAKE(scene);
    uint columns = (params.width + TILE_EDGE - 1u) / TILE_EDGE;
    uint left = tile % columns * TILE_EDGE;
    uint top = tile / columns * TILE_EDGE;
    ReceiverParts parts;
    parts.count = 0u;
    parts.complete = 1;
    for (uint bit = 0u; bit < 64u; ++bit) {
        if ((record.lit[bit / 32u] >> (bit % 32u) & 1u) == 0u) continue;
        uint pixel = (top + bit / TILE_EDGE) * params.width + left + bit % TILE_EDGE;
        add_receiver(&params, &parts, xyz(gb_position[pixel]), xyz(gb_normal[pixel]));
        uint slot = pixel_slot[pixel];
        if (slot == NO_TRIANGLE) continue;
        GLOBAL const uint* words = packet_shadows + slot / (uint)LANES * SHADOW_GROUPS;
        uint lane = slot % (uint)LANES;
        for (uint group = 0u; group < params.shadow_groups; ++group) {
            shadows.seen |= (words[group] >> lane & 1u) << group;
            shadows.hidden |= (words[group] >> (lane + 16u) & 1u) << group;
        }
    }
    if (parts.complete != 0) {
        for (uint group = 0u; group < params.shadow_groups; ++group) {
            if ((shadows.seen & ~shadows.hidden & 1u << group) == 0u) continue;
            if (group_is_open(scene, &params, &parts, light_boxes, group) != 0)
                shadows.open |= 1u << group;
        }
    }
    tile_shadows[tile] = shadows;
}
