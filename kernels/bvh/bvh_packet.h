// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Packets of LANES shadow rays that share one end point (a VPL or a sample on a light). A node is
// tested once for the whole packet by interval arithmetic; only the children that survive are
// tested lane by lane, and where few lanes are left each goes on alone. A triangle's terms are
// computed from the common point, so they are the same for all lanes. The result of a lane never
// depends on the other lanes: its own box tests decide which leaves it takes part in, and all ways
// to a leaf compute the same.
#ifndef WEFT_KERNELS_BVH_BVH_PACKET_H
#define WEFT_KERNELS_BVH_BVH_PACKET_H

#include "kernels/bvh/bvh.h"

// So many lanes of a packet, or fewer, are traced one by one.
#ifndef LONE_LANES
#define LONE_LANES 3
#endif

typedef struct {
    NFloat x, y, z;
} NFloat3;

// One axis of a packet: where its lanes' directions have one sign, the interval of their inverses.
typedef struct {
    float lowest, highest;
    uint far;   // 0 where the upper plane is the far one
    int mixed;  // 1 where the lanes' signs differ: the axis cannot cull for the packet
} PacketAxis;

// A packet, and its lanes one by one.
typedef struct {
    float3 origin;
    WFloat3 d, inverse;
    WFloat reach;  // sum of the components of d
    PacketAxis axis_x, axis_y, axis_z;
    float lane_d[3][LANES];
    float lane_inverse[3][LANES];
    float lane_reach[LANES];
} Packet;

// Terms of the triangles of a leaf about the common point. The edge functions of a direction d are
// its scalar products with bc, ca and ab; it meets the plane at height / (d . normal).
typedef struct {
    NFloat3 bc, ca, ab, normal;
    NFloat height;
    NFloat tolerance;  // times the reach of d: more than rounding can change an edge function by
} LeafTerms;

#define LEAF_TERMS 14  // numbers in LeafTerms

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

/// Prepares the segments from `origin` to `origin + d`.
static inline void make_packet(float3 origin, WFloat3 d, WMask active, Packet* packet) {
    WFloat size_x = VMAX(d.x, -d.x);
    WFloat size_y = VMAX(d.y, -d.y);
    WFloat size_z = VMAX(d.z, -d.z);
    WFloat size_xy = VMAX(size_x, size_y);
    WFloat smallest = VMAX(size_xy, size_z) * WIDE(1.0e-18f);
    packet->origin = origin;
    packet->d = d;
    packet->reach = size_x + size_y + size_z;
    wide_store(packet->reach, packet->lane_reach, 0);
    packet->inverse.x = wide_inverse(d.x, smallest);
    packet->inverse.y = wide_inverse(d.y, smallest);
    packet->inverse.z = wide_inverse(d.z, smallest);
    packet->axis_x = packet_axis(packet->inverse.x, active);
    packet->axis_y = packet_axis(packet->inverse.y, active);
    packet->axis_z = packet_axis(packet->inverse.z, active);
    wide_store(d.x, packet->lane_d[0], 0);
    wide_store(d.y, packet->lane_d[1], 0);
    wide_store(d.z, packet->lane_d[2], 0);
    wide_store(packet->inverse.x, packet->lane_inverse[0], 0);
    wide_store(packet->inverse.y, packet->lane_inverse[1], 0);
    wide_store(packet->inverse.z, packet->lane_inverse[2], 0);
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

/// Children that some lane may meet, one bit each.
static inline uint intersect_node_packet(GLOBAL const BvhNode* node, const Packet* packet) {
    NFloat first = NODE(0.0f);
    NFloat last = NODE(1.0f);
    packet_slab(node, 0u, packet->origin.x, packet->axis_x, &first, &last);
    packet_slab(node, 2u, packet->origin.y, packet->axis_y, &first, &last);
    packet_slab(node, 4u, packet->origin.z, packet->axis_z, &first, &last);
    return node_mask_bits(first <= last * SLAB_PADDING);
}

/// Narrows [first, last] of every lane by one axis of one child box.
static inline void lane_slab(GLOBAL const BvhNode* node, uint row, uint child, float origin,
                             PacketAxis axis, WFloat inverse, WFloat* first, WFloat* last) {
    WFloat near_t = inverse * (node->bounds[row + axis.far][child] - origin);
    WFloat far_t = inverse * (node->bounds[row + 1u - axis.far][child] - origin);
    if (axis.mixed != 0) {
        WFloat swap = VMAX(near_t, far_t);
        near_t = VMIN(near_t, far_t);
        far_t = swap;
    }
    *first = VMAX(*first, near_t);
    *last = VMIN(*last, far_t);
}

/// Lanes that meet the box of one child.
static inline WMask intersect_child(GLOBAL const BvhNode* node, uint child, const Packet* packet) {
    WFloat first = WIDE(0.0f);
    WFloat last = WIDE(1.0f);
    lane_slab(node, 0u, child, packet->origin.x, packet->axis_x, packet->inverse.x, &first, &last);
    lane_slab(node, 2u, child, packet->origin.y, packet->axis_y, packet->inverse.y, &first, &last);
    lane_slab(node, 4u, child, packet->origin.z, packet->axis_z, packet->inverse.z, &first, &last);
    return first <= last * SLAB_PADDING;
}

static inline NFloat3 node_cross(NFloat3 a, NFloat3 b) {
    NFloat3 c;
    c.x = a.y * b.z - a.z * b.y;
    c.y = a.z * b.x - a.x * b.z;
    c.z = a.x * b.y - a.y * b.x;
    return c;
}

/// Largest magnitude of the components.
static inline NFloat node_reach(NFloat3 v) {
    NFloat x = VMAX(v.x, -v.x);
    NFloat y = VMAX(v.y, -v.y);
    NFloat z = VMAX(v.z, -v.z);
    NFloat xy = VMAX(x, y);
    return VMAX(xy, z);
}

/// (a - b) x (a + b): twice a x b and as antisymmetric, but it does not cancel on triangles that
/// are small against their distance. Divided by the edge's length, so that one tolerance serves the
/// long and the short edges of needles.
static inline NFloat3 edge_normal(NFloat3 a, NFloat3 b) {
    NFloat3 difference, sum;
    difference.x = a.x - b.x;
    difference.y = a.y - b.y;
    difference.z = a.z - b.z;
    sum.x = a.x + b.x;
    sum.y = a.y + b.y;
    sum.z = a.z + b.z;
    NFloat length = node_reach(difference);
    NFloat scale = SELECT(length > NODE(0.0f), NODE(1.0f) / length, length);
    NFloat3 normal = node_cross(difference, sum);
    normal.x = normal.x * scale;
    normal.y = normal.y * scale;
    normal.z = normal.z * scale;
    return normal;
}

/// Edge functions are d . ((b - c) x (b + c)) / |b - c| with eight roundings of 2^-24, each
/// relative to at most 4 |d| max(|a|, |b|, |c|). Around a vertex their signs may so contradict one
/// another that no triangle has the ray. Counting as inside what is outside by less than that
/// leaves no gap, and moves the outline of what blocks by some millionths of its distance.
static inline NFloat edge_tolerance(NFloat3 a, NFloat3 b, NFloat3 c) {
    NFloat reach_a = node_reach(a);
    NFloat reach_b = node_reach(b);
    NFloat reach_c = node_reach(c);
    NFloat reach_ab = VMAX(reach_a, reach_b);
    return VMAX(reach_ab, reach_c) * 1.9073486e-6f;  // 2^-19
}

static inline LeafTerms leaf_terms(float3 origin, GLOBAL const float* rows, uint count) {
    NFloat3 v0, v1, v2, a, b, c, side, other;
    LeafTerms terms;
    v0.x = node_load(rows);
    v0.y = node_load(rows + count);
    v0.z = node_load(rows + 2u * count);
    v1.x = node_load(rows + 3u * count);
    v1.y = node_load(rows + 4u * count);
    v1.z = node_load(rows + 5u * count);
    v2.x = node_load(rows + 6u * count);
    v2.y = node_load(rows + 7u * count);
    v2.z = node_load(rows + 8u * count);
    a.x = v0.x - origin.x;
    a.y = v0.y - origin.y;
    a.z = v0.z - origin.z;
    b.x = v1.x - origin.x;
    b.y = v1.y - origin.y;
    b.z = v1.z - origin.z;
    c.x = v2.x - origin.x;
    c.y = v2.y - origin.y;
    c.z = v2.z - origin.z;
    side.x = v1.x - v0.x;
    side.y = v1.y - v0.y;
    side.z = v1.z - v0.z;
    other.x = v2.x - v0.x;
    other.y = v2.y - v0.y;
    other.z = v2.z - v0.z;
    terms.bc = edge_normal(b, c);
    terms.ca = edge_normal(c, a);
    terms.ab = edge_normal(a, b);
    terms.normal = node_cross(side, other);
    terms.height = a.x * terms.normal.x + a.y * terms.normal.y + a.z * terms.normal.z;
    terms.tolerance = edge_tolerance(a, b, c);
    return terms;
}

/// Whether a lane's segment meets one of the triangles before SHADOW_END: division-free, and
/// without a gap over shared edges and vertices.
static inline int blocked_lane(const LeafTerms* terms, uint count, const Packet* packet,
                               uint lane) {
    float dx = packet->lane_d[0][lane];
    float dy = packet->lane_d[1][lane];
    float dz = packet->lane_d[2][lane];
    NFloat zero = NODE(0.0f);
    NFloat u = terms->bc.x * dx + terms->bc.y * dy + terms->bc.z * dz;
    NFloat v = terms->ca.x * dx + terms->ca.y * dy + terms->ca.z * dz;
    NFloat w = terms->ab.x * dx + terms->ab.y * dy + terms->ab.z * dz;
    NFloat along = terms->normal.x * dx + terms->normal.y * dy + terms->normal.z * dz;
    NFloat uv_lowest = VMIN(u, v);
    NFloat uv_highest = VMAX(u, v);
    NFloat lowest = VMIN(uv_lowest, w);
    NFloat highest = VMAX(uv_highest, w);
    // 0 < height / along < SHADOW_END without the division.
    NFloat end = along * SHADOW_END;
    NMask between = ((terms->height > zero) & (terms->height < end)) |
                    ((terms->height < zero) & (terms->height > end));
    NFloat tolerance = terms->tolerance * packet->lane_reach[lane];
    NMask inside = (lowest >= -tolerance) | (highest <= tolerance);
    return (node_mask_bits(inside & between) & ((1u << count) - 1u)) != 0u ? 1 : 0;
}

/// The same for one triangle, given its terms, and all lanes of a packet.
static inline WMask blocked_lanes(const float* terms, const Packet* packet) {
    WFloat3 d = packet->d;
    WFloat zero = WIDE(0.0f);
    WFloat u = d.x * terms[0] + d.y * terms[NODE_WIDTH] + d.z * terms[2 * NODE_WIDTH];
    WFloat v =
        d.x * terms[3 * NODE_WIDTH] + d.y * terms[4 * NODE_WIDTH] + d.z * terms[5 * NODE_WIDTH];
    WFloat w =
        d.x * terms[6 * NODE_WIDTH] + d.y * terms[7 * NODE_WIDTH] + d.z * terms[8 * NODE_WIDTH];
    WFloat along =
        d.x * terms[9 * NODE_WIDTH] + d.y * terms[10 * NODE_WIDTH] + d.z * terms[11 * NODE_WIDTH];
    WFloat uv_lowest = VMIN(u, v);
    WFloat uv_highest = VMAX(u, v);
    WFloat lowest = VMIN(uv_lowest, w);
    WFloat highest = VMAX(uv_highest, w);
    WFloat height = WIDE(terms[12 * NODE_WIDTH]);
    WFloat end = along * SHADOW_END;
    WMask between = ((height > zero) & (height < end)) | ((height < zero) & (height > end));
    WFloat tolerance = packet->reach * terms[13 * NODE_WIDTH];
    WMask inside = (lowest >= -tolerance) | (highest <= tolerance);
    return inside & between;
}

/// One bit for each lane of `lanes` that a triangle of the leaf blocks.
static inline uint blocked_by_leaf(GLOBAL const float* leaves, uint reference, const Packet* packet,
                                   uint lanes) {
    GLOBAL const float* rows;
    uint count = leaf_triangles(leaves, reference, &rows);
    LeafTerms terms = leaf_terms(packet->origin, rows, count);
    uint blocked = 0u;
    if (bit_count(lanes) <= count) {
        while (lanes != 0u) {
            uint lane = lowest_bit(lanes);
            lanes &= lanes - 1u;
            if (blocked_lane(&terms, count, packet, lane) != 0) blocked |= 1u << lane;
        }
        return blocked;
    }
    float numbers[LEAF_TERMS * NODE_WIDTH];
    node_store(terms.bc.x, numbers);
    node_store(terms.bc.y, numbers + NODE_WIDTH);
    node_store(terms.bc.z, numbers + 2 * NODE_WIDTH);
    node_store(terms.ca.x, numbers + 3 * NODE_WIDTH);
    node_store(terms.ca.y, numbers + 4 * NODE_WIDTH);
    node_store(terms.ca.z, numbers + 5 * NODE_WIDTH);
    node_store(terms.ab.x, numbers + 6 * NODE_WIDTH);
    node_store(terms.ab.y, numbers + 7 * NODE_WIDTH);
    node_store(terms.ab.z, numbers + 8 * NODE_WIDTH);
    node_store(terms.normal.x, numbers + 9 * NODE_WIDTH);
    node_store(terms.normal.y, numbers + 10 * NODE_WIDTH);
    node_store(terms.normal.z, numbers + 11 * NODE_WIDTH);
    node_store(terms.height, numbers + 12 * NODE_WIDTH);
    node_store(terms.tolerance, numbers + 13 * NODE_WIDTH);
    for (uint i = 0u; i < count; ++i) blocked |= mask_bits(blocked_lanes(numbers + i, packet));
    return blocked & lanes;
}

/// Whether a lane's segment is blocked below node `root`. Uses the stack from `base` on.
static inline int blocked_alone(GLOBAL const BvhNode* nodes, GLOBAL const float* leaves, uint root,
                                const Packet* packet, uint lane, uint* stack, uint base) {
    SlabRay ray = make_slab_ray(packet->origin,
                                f3(packet->lane_inverse[0][lane], packet->lane_inverse[1][lane],
                                   packet->lane_inverse[2][lane]));
    uint size = base;
    stack[size++] = root;
    while (size > base) {
        GLOBAL const BvhNode* node = nodes + stack[--size];
        NFloat entry;
        uint bits = intersect_node(node, &ray, 1.0f, &entry);
        while (bits != 0u) {
            uint reference = node->child[lowest_bit(bits)];
            bits &= bits - 1u;
            if ((reference & BVH_LEAF) == 0u) {
                stack[size++] = reference;
                prefetch_child(nodes, leaves, reference);
                continue;
            }
            GLOBAL const float* rows;
            uint count = leaf_triangles(leaves, reference, &rows);
            LeafTerms terms = leaf_terms(packet->origin, rows, count);
            if (blocked_lane(&terms, count, packet, lane) != 0) return 1;
        }
    }
    return 0;
}

/// Lanes of `active` whose segment from `origin` to `origin + d` is blocked before SHADOW_END.
static inline WMask bvh_any_packet(GLOBAL const BvhNode* nodes, GLOBAL const float* leaves,
                                   float3 origin, WFloat3 d, WMask active) {
    uint stack[BVH_STACK];
    Packet packet;
    make_packet(origin, d, active, &packet);
    uint searching = mask_bits(active);
    uint occluded = 0u;
    uint size = 1u;
    stack[0] = 0u;
    while (size > 0u) {
        GLOBAL const BvhNode* node = nodes + stack[--size];
        uint bits = intersect_node_packet(node, &packet);
        while (bits != 0u) {
            uint child = lowest_bit(bits);
            bits &= bits - 1u;
            uint reference = node->child[child];
            if (reference == BVH_EMPTY) continue;
            uint inside = mask_bits(intersect_child(node, child, &packet)) & searching;
            if (inside == 0u) continue;
            uint blocked = 0u;
            if ((reference & BVH_LEAF) != 0u) {
                blocked = blocked_by_leaf(leaves, reference, &packet, inside);
            } else if (bit_count(inside) > LONE_LANES) {
                stack[size++] = reference;
                prefetch_child(nodes, leaves, reference);
            } else {
                while (inside != 0u) {
                    uint lane = lowest_bit(inside);
                    inside &= inside - 1u;
                    if (blocked_alone(nodes, leaves, reference, &packet, lane, stack, size) != 0)
                        blocked |= 1u << lane;
                }
            }
            occluded |= blocked;
            searching &= ~blocked;
            if (searching == 0u) return mask_of(occluded);
        }
    }
    return mask_of(occluded);
}

#endif
