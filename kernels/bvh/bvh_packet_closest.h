// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Closest hits of LANES rays from one point, such as primary rays: nodes are tested for the whole
// packet as in bvh_packet.h, triangles one by one for all lanes that meet their leaf, or, where
// these are few, lane by lane as in bvh.h. Every lane has the hit that bvh_closest finds, bit for
// bit: it takes part in the leaves whose boxes it meets, and of equally distant triangles the one
// with the smallest id wins.
#ifndef WEFT_KERNELS_BVH_BVH_PACKET_CLOSEST_H
#define WEFT_KERNELS_BVH_BVH_PACKET_CLOSEST_H

#include "kernels/bvh/bvh_packet.h"

// Directions of a packet's rays.
typedef struct {
    float x[LANES], y[LANES], z[LANES];
} PacketDirections;

// How triangles are sheared before they are tested (Ray, triangle.h) where the same axes serve all
// lanes: the axes, the common point along them, and the lanes' shears.
typedef struct {
    uint axis_x, axis_y, axis_z;
    float start_x, start_y, start_z;
    float x[LANES], y[LANES], z[LANES];
} PacketShear;

// A traversal under way.
typedef struct {
    Packet packet;
    PacketShear shear;
    int sheared;                         // 1 where `shear` serves, else `rays` do
    Ray rays[LANES];                     // undefined where `shear` serves
    float t[LANES], u[LANES], v[LANES];  // hits so far
    float id[LANES];                     // as in leaves; RAY_INFINITY: none
    float farthest;                      // largest `t` of the lanes in use
} ClosestPacket;

/// Children that some lane may meet before its hit so far, one bit each, and how near at least.
static inline uint closest_children(GLOBAL const BvhNode* node, const ClosestPacket* state,
                                    float* entries) {
    const Packet* packet = &state->packet;
    NFloat first = NODE(0.0f);
    NFloat last = NODE(state->farthest);
    packet_slab(node, 0u, packet->origin.x, packet->axis_x, &first, &last);
    packet_slab(node, 2u, packet->origin.y, packet->axis_y, &first, &last);
    packet_slab(node, 4u, packet->origin.z, packet->axis_z, &first, &last);
    node_store(first, entries);
    return node_mask_bits(first <= last * SLAB_PADDING);
}

/// Lanes that meet the box of one child before their hit so far, one bit each.
static inline uint closest_lanes(GLOBAL const BvhNode* node, uint child,
                                 const ClosestPacket* state) {
    const Packet* packet = &state->packet;
    WFloat first = WIDE(0.0f);
    WFloat last = wide_load(state->t, 0);
    lane_slab(node, 0u, child, packet->origin.x, packet->axis_x, packet->inverse.x, &first, &last);
    lane_slab(node, 2u, child, packet->origin.y, packet->axis_y, packet->inverse.y, &first, &last);
    lane_slab(node, 4u, child, packet->origin.z, packet->axis_z, packet->inverse.z, &first, &last);
    return mask_bits(first <= last * SLAB_PADDING);
}

/// Tests one triangle, `rows[k * count]` being its rows, with some lanes; as intersect_triangles.
static inline void closest_of_triangle(GLOBAL const float* rows, uint count, WMask lanes,
                                       ClosestPacket* state) {
    const PacketShear* shear = &state->shear;
    GLOBAL const float* x = rows + shear->axis_x * count;
    GLOBAL const float* y = rows + shear->axis_y * count;
    GLOBAL const float* z = rows + shear->axis_z * count;
    uint vertex = 3u * count;
    WFloat shear_x = wide_load(shear->x, 0);
    WFloat shear_y = wide_load(shear->y, 0);
    WFloat az = WIDE(z[0] - shear->start_z);
    WFloat bz = WIDE(z[vertex] - shear->start_z);
    WFloat cz = WIDE(z[2u * vertex] - shear->start_z);
    WFloat ax = WIDE(x[0] - shear->start_x) - az * shear_x;
    WFloat ay = WIDE(y[0] - shear->start_y) - az * shear_y;
    WFloat bx = WIDE(x[vertex] - shear->start_x) - bz * shear_x;
    WFloat by = WIDE(y[vertex] - shear->start_y) - bz * shear_y;
    WFloat cx = WIDE(x[2u * vertex] - shear->start_x) - cz * shear_x;
    WFloat cy = WIDE(y[2u * vertex] - shear->start_y) - cz * shear_y;
    WFloat u = cx * by - cy * bx;
    WFloat v = ax * cy - ay * cx;
    WFloat w = bx * ay - by * ax;
    WFloat zero = WIDE(0.0f);
    WFloat determinant = u + v + w;
    WFloat uv_lowest = VMIN(u, v);
    WFloat uv_highest = VMAX(u, v);
    WFloat lowest = VMIN(uv_lowest, w);
    WFloat highest = VMAX(uv_highest, w);
    WMask inside = ((lowest >= zero) | (highest <= zero)) & (determinant != zero) & lanes;
    if (mask_any(inside) == 0) return;
    WFloat weight_v = v / determinant;
    WFloat weight_w = w / determinant;
    WFloat t = (u / determinant * az + weight_v * bz + weight_w * cz) * wide_load(shear->z, 0);
    WFloat best_t = wide_load(state->t, 0);
    WFloat best_id = wide_load(state->id, 0);
    // Ids of leaves are positive floats, which compare as their bits do.
    WFloat id = WIDE(rows[LEAF_ID_ROW * count]);
    WMask closer = inside & (t > zero) & ((t < best_t) | ((t == best_t) & (id < best_id)));
    wide_store(SELECT(closer, t, best_t), state->t, 0);
    wide_store(SELECT(closer, id, best_id), state->id, 0);
    wide_store(SELECT(closer, weight_v, wide_load(state->u, 0)), state->u, 0);
    wide_store(SELECT(closer, weight_w, wide_load(state->v, 0)), state->v, 0);
}

/// A lane's ray, for intersect_triangles.
static inline Ray lane_ray(const ClosestPacket* state, uint lane) {
    if (state->sheared == 0) return state->rays[lane];
    const PacketShear* shear = &state->shear;
    Ray ray;
    ray.axis_x = shear->axis_x;
    ray.axis_y = shear->axis_y;
    ray.axis_z = shear->axis_z;
    ray.start_x = shear->start_x;
    ray.start_y = shear->start_y;
    ray.start_z = shear->start_z;
    ray.shear_x = shear->x[lane];
    ray.shear_y = shear->y[lane];
    ray.shear_z = shear->z[lane];
    return ray;
}

static inline Hit lane_hit(const ClosestPacket* state, uint lane) {
    Hit hit;
    float id = state->id[lane];
    hit.triangle = id == RAY_INFINITY ? INVALID_INDEX : as_bits(id) & LEAF_ID_MASK;
    hit.t = state->t[lane];
    hit.u = state->u[lane];
    hit.v = state->v[lane];
    return hit;
}

/// Tests the triangles of a leaf with some lanes.
static inline void closest_in_leaf_packet(GLOBAL const float* leaves, uint reference, uint lanes,
                                          uint active, ClosestPacket* state) {
    GLOBAL const float* rows;
    uint count = leaf_triangles(leaves, reference, &rows);
    if (state->sheared != 0 && bit_count(lanes) > count) {
        WMask mask = mask_of(lanes);
        for (uint i = 0u; i < count; ++i) closest_of_triangle(rows + i, count, mask, state);
    } else {
        while (lanes != 0u) {
            uint lane = lowest_bit(lanes);
            lanes &= lanes - 1u;
            Ray ray = lane_ray(state, lane);
            Hit hit = lane_hit(state, lane);
            uint before = hit.triangle;
            closest_in_leaf(leaves, reference, &ray, &hit);
            if (hit.triangle == before) continue;
            state->t[lane] = hit.t;
            state->u[lane] = hit.u;
            state->v[lane] = hit.v;
            state->id[lane] = from_bits(hit.triangle | LEAF_ID_FLAG);
        }
    }
    WFloat reach = wide_load(state->t, 0);
    state->farthest = wide_highest(SELECT(mask_of(active), reach, WIDE(0.0f)));
}

/// The shear of make_ray for all lanes. Returns 0 where no one choice of axes serves them.
static inline int make_shear(float3 origin, WFloat3 d, uint active, PacketShear* shear) {
    WFloat size_x = VMAX(d.x, -d.x);
    WFloat size_y = VMAX(d.y, -d.y);
    WFloat size_z = VMAX(d.z, -d.z);
    uint beyond_y = mask_bits(size_x > size_y);
    uint along_x = beyond_y & mask_bits(size_x > size_z) & active;
    uint along_y = ~beyond_y & mask_bits(size_y > size_z) & active;
    int common = along_x == active || along_y == active || (along_x | along_y) == 0u ? 1 : 0;
    shear->axis_z = along_x == active ? 0u : (along_y == active ? 1u : 2u);
    WFloat along = shear->axis_z == 0u ? d.x : (shear->axis_z == 1u ? d.y : d.z);
    WFloat across = shear->axis_z == 0u ? d.y : (shear->axis_z == 1u ? d.z : d.x);
    WFloat up = shear->axis_z == 0u ? d.z : (shear->axis_z == 1u ? d.x : d.y);
    uint backwards = mask_bits(along < WIDE(0.0f)) & active;
    if (backwards != 0u && backwards != active) common = 0;
    shear->axis_x = shear->axis_z == 2u ? 0u : shear->axis_z + 1u;
    shear->axis_y = shear->axis_x == 2u ? 0u : shear->axis_x + 1u;
    if (backwards != 0u) {
        uint swap = shear->axis_x;
        shear->axis_x = shear->axis_y;
        shear->axis_y = swap;
    }
    wide_store((backwards != 0u ? up : across) / along, shear->x, 0);
    wide_store((backwards != 0u ? across : up) / along, shear->y, 0);
    wide_store(WIDE(1.0f) / along, shear->z, 0);
    shear->start_x = component(origin, shear->axis_x);
    shear->start_y = component(origin, shear->axis_y);
    shear->start_z = component(origin, shear->axis_z);
    return common;
}

static inline void begin_closest(float3 origin, const PacketDirections* directions, uint active,
                                 float t_max, ClosestPacket* state) {
    WFloat3 d;
    d.x = wide_load(directions->x, 0);
    d.y = wide_load(directions->y, 0);
    d.z = wide_load(directions->z, 0);
    make_packet(origin, d, mask_of(active), &state->packet);
    state->sheared = make_shear(origin, d, active, &state->shear);
    if (state->sheared == 0)
        for (uint lane = 0u; lane < LANES; ++lane)
            state->rays[lane] =
                make_ray(origin, f3(directions->x[lane], directions->y[lane], directions->z[lane]));
    wide_store(WIDE(t_max), state->t, 0);
    wide_store(WIDE(0.0f), state->u, 0);
    wide_store(WIDE(0.0f), state->v, 0);
    wide_store(WIDE(RAY_INFINITY), state->id, 0);
    state->farthest = t_max;
}

/// Closest hits within (0, t_max] of the lanes of `active`, for lane_hit. The directions of the
/// others are those of any ray.
static inline void bvh_closest_packet(GLOBAL const BvhNode* nodes, GLOBAL const float* leaves,
                                      float3 origin, const PacketDirections* directions,
                                      uint active, float t_max, ClosestPacket* state) {
    // A child waits as its node and place in it, so that lanes meet its box when its turn comes.
    uint stack[BVH_STACK];
    float stack_entry[BVH_STACK];
    float entries[NODE_WIDTH];
    begin_closest(origin, directions, active, t_max, state);
    uint size = 0u;
    uint index = 0u;
    for (;;) {
        GLOBAL const BvhNode* node = nodes + index;
        uint bits = closest_children(node, state, entries);
        uint base = size;
        while (bits != 0u) {
            uint child = lowest_bit(bits);
            bits &= bits - 1u;
            if (node->child[child] == BVH_EMPTY) continue;
            uint place = size++;
            while (place > base && stack_entry[place - 1u] < entries[child]) {
                stack[place] = stack[place - 1u];
                stack_entry[place] = stack_entry[place - 1u];
                --place;
            }
            stack[place] = index * NODE_WIDTH + child;
            stack_entry[place] = entries[child];
        }
        for (;;) {
            if (size == 0u) return;
            --size;
            if (stack_entry[size] > state->farthest * SLAB_PADDING) continue;
            GLOBAL const BvhNode* parent = nodes + stack[size] / NODE_WIDTH;
            uint child = stack[size] % NODE_WIDTH;
            uint lanes = closest_lanes(parent, child, state) & active;
            if (lanes == 0u) continue;
            uint reference = parent->child[child];
            if ((reference & BVH_LEAF) != 0u) {
                closest_in_leaf_packet(leaves, reference, lanes, active, state);
                continue;
            }
            index = reference;
            break;
        }
    }
}

#endif
