// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Packets of LANES shadow rays that share one end point (a VPL or a sample on a light). A node is
// tested once for the whole packet by interval arithmetic; only the children that survive are
// tested lane by lane. A triangle's terms are computed from the common point, so they are scalars
// for the packet. What a lane reports never depends on its company: the lane's own box test decides
// which leaves it takes part in.
#ifndef WEFT_BVH_PACKET_H
#define WEFT_BVH_PACKET_H

#include "bvh.h"

typedef struct {
    WFloat x, y, z;
} WFloat3;

// One axis of a packet: where its lanes' directions have one sign, the interval of their inverses.
typedef struct {
    float lowest, highest;
    uint far;   // 0 where the upper plane is the far one
    int mixed;  // 1 where the lanes' signs differ: the axis cannot cull for the packet
} PacketAxis;

static inline WFloat wide_inverse(WFloat d, WFloat smallest) {
    // The slab test needs a finite reciprocal; see make_ray.
    WFloat size = VMAX(d, -d);
    WFloat sign = SELECT(d < WIDE(0.0f), WIDE(-1.0f), WIDE(1.0f));
    return WIDE(1.0f) / SELECT(size < smallest, sign * smallest, d);
}

static inline PacketAxis packet_axis(WFloat inverse, WMask active) {
    PacketAxis axis;
    axis.lowest = wide_lowest(SELECT(active, inverse, WIDE(RAY_INFINITY)));
    axis.highest = wide_highest(SELECT(active, inverse, WIDE(-RAY_INFINITY)));
    axis.far = axis.lowest < 0.0f ? 1u : 0u;
    axis.mixed = axis.lowest < 0.0f && axis.highest > 0.0f ? 1 : 0;
    return axis;
}

/// Narrows [first, last] of all children by one axis, for every lane of the packet at once.
static inline void packet_slab(GLOBAL const BvhNode* node, uint row, float origin, PacketAxis axis,
                               NFloat* first, NFloat* last) {
    if (axis.mixed != 0) return;
    NFloat near_plane = node_load(node->bounds[row + axis.far]) - origin;
    NFloat far_plane = node_load(node->bounds[row + 1u - axis.far]) - origin;
    NFloat near_a = near_plane * axis.lowest;
    NFloat near_b = near_plane * axis.highest;
    NFloat far_a = far_plane * axis.lowest;
    NFloat far_b = far_plane * axis.highest;
    NFloat near_t = VMIN(near_a, near_b);
    NFloat far_t = VMAX(far_a, far_b);
    *first = VMAX(*first, near_t);
    *last = VMIN(*last, far_t);
}

/// Narrows [first, last] of every lane by one axis of one child box.
static inline void lane_slab(float lower, float upper, WFloat inverse, WFloat* first,
                             WFloat* last) {
    WFloat a = inverse * lower;
    WFloat b = inverse * upper;
    WFloat near_t = VMIN(a, b);
    WFloat far_t = VMAX(a, b);
    *first = VMAX(*first, near_t);
    *last = VMIN(*last, far_t);
}

/// Lanes whose segment from `origin` along `d` meets the triangle before SHADOW_END, by
/// edge functions about the common point; division-free and antisymmetric over shared edges.
static inline WMask packet_triangle(float3 origin, WFloat3 d, GLOBAL const BvhTriangle* triangle) {
    float3 a = xyz(triangle->v0) - origin;
    float3 b = xyz(triangle->v1) - origin;
    float3 c = xyz(triangle->v2) - origin;
    // (b - c) x (b + c) is twice b x c and as antisymmetric, but does not cancel on triangles that
    // are small against their distance.
    float3 bc = cross3(b - c, b + c);
    float3 ca = cross3(c - a, c + a);
    float3 ab = cross3(a - b, a + b);
    float3 normal =
        cross3(xyz(triangle->v1) - xyz(triangle->v0), xyz(triangle->v2) - xyz(triangle->v0));
    float height = dot3(a, normal);
    WFloat u = d.x * bc.x + d.y * bc.y + d.z * bc.z;
    WFloat v = d.x * ca.x + d.y * ca.y + d.z * ca.z;
    WFloat w = d.x * ab.x + d.y * ab.y + d.z * ab.z;
    WFloat along = d.x * normal.x + d.y * normal.y + d.z * normal.z;
    WFloat zero = WIDE(0.0f);
    WFloat plane = WIDE(height);
    WMask inside =
        ((u >= zero) & (v >= zero) & (w >= zero)) | ((u <= zero) & (v <= zero) & (w <= zero));
    // 0 < height / along < SHADOW_END without the division.
    WFloat end = along * SHADOW_END;
    WMask between = ((plane > zero) & (plane < end)) | ((plane < zero) & (plane > end));
    return inside & between;
}

/// Lanes of `active` whose segment from `origin` to `origin + d` is blocked before SHADOW_END.
static inline WMask bvh_any_packet(GLOBAL const BvhNode* nodes, GLOBAL const BvhTriangle* triangles,
                                   float3 origin, WFloat3 d, WMask active) {
    uint stack[BVH_STACK];
    WFloat size_x = VMAX(d.x, -d.x);
    WFloat size_y = VMAX(d.y, -d.y);
    WFloat size_z = VMAX(d.z, -d.z);
    WFloat size_xy = VMAX(size_x, size_y);
    WFloat smallest = VMAX(size_xy, size_z) * WIDE(1.0e-18f);
    WFloat3 inverse;
    inverse.x = wide_inverse(d.x, smallest);
    inverse.y = wide_inverse(d.y, smallest);
    inverse.z = wide_inverse(d.z, smallest);
    PacketAxis axis_x = packet_axis(inverse.x, active);
    PacketAxis axis_y = packet_axis(inverse.y, active);
    PacketAxis axis_z = packet_axis(inverse.z, active);
    WMask occluded = mask_none_set;
    WMask searching = active;
    uint size = 1u;
    stack[0] = 0u;
    while (size > 0u) {
        GLOBAL const BvhNode* node = nodes + stack[--size];
        NFloat packet_first = NODE(0.0f);
        NFloat packet_last = NODE(1.0f);
        packet_slab(node, 0u, origin.x, axis_x, &packet_first, &packet_last);
        packet_slab(node, 2u, origin.y, axis_y, &packet_first, &packet_last);
        packet_slab(node, 4u, origin.z, axis_z, &packet_first, &packet_last);
        uint bits = node_mask_bits(packet_first <= packet_last * SLAB_PADDING);
        while (bits != 0u) {
            uint child = lowest_bit(bits);
            bits &= bits - 1u;
            uint reference = node->child[child];
            if (reference == BVH_EMPTY) continue;
            WFloat first = WIDE(0.0f);
            WFloat last = WIDE(1.0f);
            lane_slab(node->bounds[0][child] - origin.x, node->bounds[1][child] - origin.x,
                      inverse.x, &first, &last);
            lane_slab(node->bounds[2][child] - origin.y, node->bounds[3][child] - origin.y,
                      inverse.y, &first, &last);
            lane_slab(node->bounds[4][child] - origin.z, node->bounds[5][child] - origin.z,
                      inverse.z, &first, &last);
            WMask inside = searching & (first <= last * SLAB_PADDING);
            if (!mask_any(inside)) continue;
            if ((reference & BVH_LEAF) == 0u) {
                stack[size++] = reference;
                continue;
            }
            uint begin = reference & BVH_FIRST_MASK;
            uint end = begin + ((reference >> BVH_COUNT_SHIFT) & BVH_COUNT_MASK);
            for (uint i = begin; i < end; ++i)
                occluded = occluded | (inside & packet_triangle(origin, d, triangles + i));
            searching = active & mask_not(occluded);
            if (!mask_any(searching)) return occluded;
        }
    }
    return occluded;
}

#endif
