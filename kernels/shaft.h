// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Shafts (Haines and Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", 1994): the convex
// hull of a box of receivers and the box of a light. Where no triangle touches it, every shadow ray
// between the two is known to be free, and none has to be traced. The answer is conservative: it is
// "open" only where that is proven in spite of rounding.
#ifndef WEFT_SHAFT_H
#define WEFT_SHAFT_H

#include "trace.h"

// Nodes after which the search gives up.
#define SHAFT_NODES 256
// Share of the extent. Rays start surface_offset (24 half-ulps of the extent at most) off their
// surface; heights over a plane, of a vertex and of the shaft, take 8 half-ulps of twice the extent
// each.
#define SHAFT_MARGIN 3.8146973e-6f  // 2^-18
#define SHAFT_EDGES 11u             // directions of the hull's edges
// What lies less far than this in front of a receiver's or light's plane belongs to it: rays start
// beyond it, see surface_offset.
#define SHAFT_PLANE_REACH 9.5367432e-7f  // 2^-20
// Margins below this may be lost to underflow; then nothing is proven by them.
#define SHAFT_LEAST 1.0e-30f

// A plane that touches an edge of each box and is parallel to the third axis. A point lies outside
// where u x[axis_u] + v x[axis_v] > limit, which includes the margin.
typedef struct {
    float u, v, limit;
    uint axis_u, axis_v;
} ShaftPlane;

typedef struct {
    float3 a_low, a_high, b_low, b_high;
    float3 low, high;  // of both boxes, with the margin
    float4 front[2];   // xyz . normal <= w: on or behind the plane
    ShaftPlane planes[12];
    uint plane_count, front_count;
    float extent;
} Shaft;

/// Adds the planes that are parallel to the axis other than these two.
static inline void add_shaft_planes(Shaft* shaft, uint axis_u, uint axis_v) {
    for (uint corner = 0u; corner < 4u; ++corner) {
        int up_u = (corner & 1u) != 0u ? 1 : 0;
        int up_v = (corner & 2u) != 0u ? 1 : 0;
        // Mirrored so that the corner is the upper one of both axes.
        float a_u = up_u ? component(shaft->a_high, axis_u) : -component(shaft->a_low, axis_u);
        float a_v = up_v ? component(shaft->a_high, axis_v) : -component(shaft->a_low, axis_v);
        float b_u = up_u ? component(shaft->b_high, axis_u) : -component(shaft->b_low, axis_u);
        float b_v = up_v ? component(shaft->b_high, axis_v) : -component(shaft->b_low, axis_v);
        float d_u = a_u - b_u;
        float d_v = a_v - b_v;
        // Otherwise one box reaches further along both, and the faces of the union bound the hull.
        if (!((d_u > 0.0f && d_v < 0.0f) || (d_u < 0.0f && d_v > 0.0f))) continue;
        float n_u = absolute(d_v);
        float n_v = absolute(d_u);
        float margin = (n_u + n_v) * (SHAFT_MARGIN * shaft->extent);
        if (!(margin > SHAFT_LEAST)) continue;
        // Whatever the normal's rounding: these corners are the outermost of their boxes along it.
        float at_a = n_u * a_u + n_v * a_v;
        float at_b = n_u * b_u + n_v * b_v;
        ShaftPlane plane;
        plane.u = up_u ? n_u : -n_u;
        plane.v = up_v ? n_v : -n_v;
        plane.limit = m_max(at_a, at_b) + margin;
        plane.axis_u = axis_u;
        plane.axis_v = axis_v;
        shaft->planes[shaft->plane_count++] = plane;
    }
}

/// Adds a plane (unit normal into the shaft, offset) of receivers or light; a normal of 0 stands
/// for none. Returns 0 where it is no plane.
static inline int add_shaft_front(Shaft* shaft, float4 plane, float extent) {
    float3 n = xyz(plane);
    float square = dot3(n, n);
    if (square == 0.0f) return 1;
    if (!(square > 0.999f && square < 1.001f) || !is_finite1(plane.w)) return 0;
    float limit = plane.w + SHAFT_PLANE_REACH * extent;
    shaft->front[shaft->front_count++] = f4(n.x, n.y, n.z, limit);
    return 1;
}

/// Makes the shaft between the receivers in box a and the light in box b. Nothing on or behind the
/// plane of the receivers or of the light can block; see add_shaft_front. `extent` is that of
/// Params. Returns 0 where nothing could be proven: boxes that overlap or are none, Inf or NaN.
static inline int make_shaft(float3 a_low, float3 a_high, float3 b_low, float3 b_high,
                             float4 receiver_plane, float4 light_plane, float extent,
                             Shaft* shaft) {
    if (!is_finite3(a_low) || !is_finite3(a_high) || !is_finite3(b_low) || !is_finite3(b_high))
        return 0;
    if (!(min_component(a_high - a_low) >= 0.0f && min_component(b_high - b_low) >= 0.0f)) return 0;
    if (min_component(a_high - b_low) > 0.0f && min_component(b_high - a_low) > 0.0f) return 0;
    float3 low = lowest3(a_low, b_low);
    float3 high = highest3(a_high, b_high);
    float reach = m_max(max_component(absolute3(low)), max_component(absolute3(high)));
    float margin = SHAFT_MARGIN * m_max(extent, reach);
    if (!is_finite1(extent) || !(margin > SHAFT_LEAST)) return 0;
    shaft->a_low = a_low;
    shaft->a_high = a_high;
    shaft->b_low = b_low;
    shaft->b_high = b_high;
    shaft->low = low - f3(margin, margin, margin);
    shaft->high = high + f3(margin, margin, margin);
    shaft->plane_count = 0u;
    shaft->front_count = 0u;
    shaft->extent = m_max(extent, reach);
    add_shaft_planes(shaft, 0u, 1u);
    add_shaft_planes(shaft, 1u, 2u);
    add_shaft_planes(shaft, 2u, 0u);
    if (add_shaft_front(shaft, receiver_plane, extent) == 0) return 0;
    return add_shaft_front(shaft, light_plane, extent);
}

/// Children of a node that may touch the shaft, one bit each.
static inline uint shaft_children(GLOBAL const BvhNode* node, const Shaft* shaft) {
    NMask outside = (node_load(node->bounds[0]) > NODE(shaft->high.x)) |
                    (node_load(node->bounds[1]) < NODE(shaft->low.x)) |
                    (node_load(node->bounds[2]) > NODE(shaft->high.y)) |
                    (node_load(node->bounds[3]) < NODE(shaft->low.y)) |
                    (node_load(node->bounds[4]) > NODE(shaft->high.z)) |
                    (node_load(node->bounds[5]) < NODE(shaft->low.z));
    for (uint i = 0u; i < shaft->front_count; ++i) {
        float4 front = shaft->front[i];
        NFloat x = node_load(node->bounds[front.x < 0.0f ? 0 : 1]);
        NFloat y = node_load(node->bounds[front.y < 0.0f ? 2 : 3]);
        NFloat z = node_load(node->bounds[front.z < 0.0f ? 4 : 5]);
        NFloat height = x * front.x + y * front.y + z * front.z;
        outside = outside | (height <= NODE(front.w));
    }
    for (uint i = 0u; i < shaft->plane_count; ++i) {
        const ShaftPlane* plane = &shaft->planes[i];
        NFloat u = node_load(node->bounds[2u * plane->axis_u + (plane->u < 0.0f ? 1u : 0u)]);
        NFloat v = node_load(node->bounds[2u * plane->axis_v + (plane->v < 0.0f ? 1u : 0u)]);
        NFloat height = u * plane->u + v * plane->v;
        outside = outside | (height > NODE(plane->limit));
    }
    return ~node_mask_bits(outside) & 0xFFu;
}

static inline NFloat node_lowest_of_3(NFloat a, NFloat b, NFloat c) {
    NFloat ab = VMIN(a, b);
    return VMIN(ab, c);
}

static inline NFloat node_highest_of_3(NFloat a, NFloat b, NFloat c) {
    NFloat ab = VMAX(a, b);
    return VMAX(ab, c);
}

/// Triangles of a leaf that lie beyond one plane of the shaft, one bit each.
static inline uint leaf_beyond_planes(GLOBAL const float* rows, uint count, const Shaft* shaft) {
    NFloat low[3], high[3];
    for (uint axis = 0u; axis < 3u; ++axis) {
        NFloat a = node_load(rows + axis * count);
        NFloat b = node_load(rows + (3u + axis) * count);
        NFloat c = node_load(rows + (6u + axis) * count);
        low[axis] = node_lowest_of_3(a, b, c);
        high[axis] = node_highest_of_3(a, b, c);
    }
    NMask outside = (low[0] > NODE(shaft->high.x)) | (high[0] < NODE(shaft->low.x)) |
                    (low[1] > NODE(shaft->high.y)) | (high[1] < NODE(shaft->low.y)) |
                    (low[2] > NODE(shaft->high.z)) | (high[2] < NODE(shaft->low.z));
    for (uint i = 0u; i < shaft->front_count; ++i) {
        float4 front = shaft->front[i];
        NFloat height[3];
        for (uint k = 0u; k < 3u; ++k) {
            GLOBAL const float* vertex = rows + 3u * k * count;
            height[k] = node_load(vertex) * front.x + node_load(vertex + count) * front.y +
                        node_load(vertex + 2u * count) * front.z;
        }
        outside = outside | (node_highest_of_3(height[0], height[1], height[2]) <= NODE(front.w));
    }
    for (uint i = 0u; i < shaft->plane_count; ++i) {
        const ShaftPlane* plane = &shaft->planes[i];
        GLOBAL const float* row_u = rows + plane->axis_u * count;
        GLOBAL const float* row_v = rows + plane->axis_v * count;
        NFloat height[3];
        for (uint k = 0u; k < 3u; ++k)
            height[k] = node_load(row_u + 3u * k * count) * plane->u +
                        node_load(row_v + 3u * k * count) * plane->v;
        outside =
            outside | (node_lowest_of_3(height[0], height[1], height[2]) > NODE(plane->limit));
    }
    return node_mask_bits(outside);
}

// The triangles of a leaf about their first vertices: their sides, and the corners of both boxes.
typedef struct {
    NFloat3 side, other;
    NFloat3 a_low, a_high, b_low, b_high;
} ShaftLeaf;

static inline NFloat3 node_difference(float3 corner, NFloat3 v) {
    NFloat3 d;
    d.x = corner.x - v.x;
    d.y = corner.y - v.y;
    d.z = corner.z - v.z;
    return d;
}

static inline ShaftLeaf shaft_leaf(GLOBAL const float* rows, uint count, const Shaft* shaft) {
    ShaftLeaf leaf;
    NFloat3 v;
    v.x = node_load(rows);
    v.y = node_load(rows + count);
    v.z = node_load(rows + 2u * count);
    leaf.side.x = node_load(rows + 3u * count) - v.x;
    leaf.side.y = node_load(rows + 4u * count) - v.y;
    leaf.side.z = node_load(rows + 5u * count) - v.z;
    leaf.other.x = node_load(rows + 6u * count) - v.x;
    leaf.other.y = node_load(rows + 7u * count) - v.y;
    leaf.other.z = node_load(rows + 8u * count) - v.z;
    leaf.a_low = node_difference(shaft->a_low, v);
    leaf.a_high = node_difference(shaft->a_high, v);
    leaf.b_low = node_difference(shaft->b_low, v);
    leaf.b_high = node_difference(shaft->b_high, v);
    return leaf;
}

/// Adds a box to the interval of the shaft's scalar products with `n`.
static inline void add_box(NFloat3 n, NFloat3 low, NFloat3 high, NFloat* lowest, NFloat* highest) {
    NFloat low_x = n.x * low.x;
    NFloat low_y = n.y * low.y;
    NFloat low_z = n.z * low.z;
    NFloat high_x = n.x * high.x;
    NFloat high_y = n.y * high.y;
    NFloat high_z = n.z * high.z;
    NFloat first = VMIN(low_x, high_x) + VMIN(low_y, high_y) + VMIN(low_z, high_z);
    NFloat last = VMAX(low_x, high_x) + VMAX(low_y, high_y) + VMAX(low_z, high_z);
    *lowest = VMIN(*lowest, first);
    *highest = VMAX(*highest, last);
}

/// Whether a plane with normal `n` has the triangle on one side and the shaft on the other. Any
/// normal will do, however it was rounded: all corners are measured along the same one.
static inline NMask parted_along(NFloat3 n, const ShaftLeaf* leaf, float extent) {
    NFloat at_side = n.x * leaf->side.x + n.y * leaf->side.y + n.z * leaf->side.z;
    NFloat at_other = n.x * leaf->other.x + n.y * leaf->other.y + n.z * leaf->other.z;
    NFloat lowest = NODE(RAY_INFINITY);
    NFloat highest = NODE(-RAY_INFINITY);
    add_box(n, leaf->a_low, leaf->a_high, &lowest, &highest);
    add_box(n, leaf->b_low, leaf->b_high, &lowest, &highest);
    NFloat size = VMAX(n.x, -n.x) + VMAX(n.y, -n.y) + VMAX(n.z, -n.z);
    NFloat margin = size * (SHAFT_MARGIN * extent);
    NFloat zero = NODE(0.0f);
    NMask above = lowest > node_highest_of_3(zero, at_side, at_other) + margin;
    NMask below = highest < node_lowest_of_3(zero, at_side, at_other) - margin;
    return (above | below) & (margin > NODE(SHAFT_LEAST));
}

static inline NFloat3 node_cross_with(NFloat3 a, float3 b) {
    NFloat3 c;
    c.x = a.y * b.z - a.z * b.y;
    c.y = a.z * b.x - a.x * b.z;
    c.z = a.x * b.y - a.y * b.x;
    return c;
}

/// Direction of an edge of the hull: of the boxes for 0 to 2, else from corner to like corner.
static inline float3 shaft_edge(const Shaft* shaft, uint i) {
    if (i < 3u) return f3(i == 0u ? 1.0f : 0.0f, i == 1u ? 1.0f : 0.0f, i == 2u ? 1.0f : 0.0f);
    uint corner = i - 3u;
    float3 low = shaft->b_low - shaft->a_low;
    float3 high = shaft->b_high - shaft->a_high;
    return f3((corner & 1u) != 0u ? high.x : low.x, (corner & 2u) != 0u ? high.y : low.y,
              (corner & 4u) != 0u ? high.z : low.z);
}

/// Which of these triangles of a leaf may touch the shaft, by the remaining axes along which two
/// convex bodies can be apart: the triangle's normal, and the products of an edge of each.
static inline uint touching_triangles(GLOBAL const float* rows, uint count, const Shaft* shaft,
                                      uint touching) {
    ShaftLeaf leaf = shaft_leaf(rows, count, shaft);
    NFloat3 normal = node_cross(leaf.side, leaf.other);
    touching &= ~node_mask_bits(parted_along(normal, &leaf, shaft->extent));
    NFloat3 edges[3];
    edges[0] = leaf.side;
    edges[1] = leaf.other;
    edges[2].x = leaf.other.x - leaf.side.x;
    edges[2].y = leaf.other.y - leaf.side.y;
    edges[2].z = leaf.other.z - leaf.side.z;
    for (uint i = 0u; i < 3u * SHAFT_EDGES && touching != 0u; ++i) {
        NFloat3 axis = node_cross_with(edges[i % 3u], shaft_edge(shaft, i / 3u));
        touching &= ~node_mask_bits(parted_along(axis, &leaf, shaft->extent));
    }
    return touching;
}

/// Whether all triangles of a leaf are proven not to touch the shaft.
static inline int leaf_is_clear(GLOBAL const float* leaves, uint reference, const Shaft* shaft) {
    GLOBAL const float* rows;
    uint count = leaf_triangles(leaves, reference, &rows);
    uint touching = ((1u << count) - 1u) & ~leaf_beyond_planes(rows, count, shaft);
    if (touching != 0u) touching = touching_triangles(rows, count, shaft, touching);
    return touching == 0u ? 1 : 0;
}

/// 1 only where it is proven that no triangle blocks a segment between the shaft's boxes whose ends
/// lie in front of its planes by surface_offset; else 0, also where the proof would take too long.
static inline int shaft_is_open(Scene scene, const Shaft* shaft) {
    GLOBAL const BvhNode* nodes = own_nodes(scene);
    GLOBAL const float* leaves = own_leaves(scene);
    uint stack[BVH_STACK];
    uint size = 1u;
    stack[0] = 0u;
    for (uint visited = 0u; visited < SHAFT_NODES; ++visited) {
        if (size == 0u) return 1;
        GLOBAL const BvhNode* node = nodes + stack[--size];
        uint bits = shaft_children(node, shaft);
        while (bits != 0u) {
            uint reference = node->child[lowest_bit(bits)];
            bits &= bits - 1u;
            if (reference == BVH_EMPTY) continue;
            if ((reference & BVH_LEAF) == 0u) {
                stack[size++] = reference;
                prefetch_child(nodes, leaves, reference);
            } else if (leaf_is_clear(leaves, reference, shaft) == 0) {
                return 0;
            }
        }
    }
    return size == 0u ? 1 : 0;
}

#endif
