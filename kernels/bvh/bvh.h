// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Traversal of the wide BVH by single rays. A closest hit does not depend on the tree: of equally
// distant triangles the one with the smallest id wins.
#ifndef WEFT_KERNELS_BVH_BVH_H
#define WEFT_KERNELS_BVH_BVH_H

#include "kernels/bvh/triangle.h"

// Covers the rounding of the slab test (Ize, JCGT 2013): at least 1 + 2 gamma(3).
#define SLAB_PADDING 1.0000005f

/// Which children the ray meets within (0, t_max]; `entry` receives their entry distances.
static inline uint intersect_node(GLOBAL const BvhNode* node, const SlabRay* ray, float t_max,
                                  NFloat* entry) {
    NFloat near_x = (node_load(node->bounds[ray->far_x]) - ray->origin.x) * ray->inverse.x;
    NFloat near_y = (node_load(node->bounds[2u + ray->far_y]) - ray->origin.y) * ray->inverse.y;
    NFloat near_z = (node_load(node->bounds[4u + ray->far_z]) - ray->origin.z) * ray->inverse.z;
    NFloat far_x = (node_load(node->bounds[1u - ray->far_x]) - ray->origin.x) * ray->inverse.x;
    NFloat far_y = (node_load(node->bounds[3u - ray->far_y]) - ray->origin.y) * ray->inverse.y;
    NFloat far_z = (node_load(node->bounds[5u - ray->far_z]) - ray->origin.z) * ray->inverse.z;
    NFloat near_xy = VMAX(near_x, near_y);
    NFloat near_z0 = VMAX(near_z, NODE(0.0f));
    NFloat first = VMAX(near_xy, near_z0);
    NFloat far_xy = VMIN(far_x, far_y);
    NFloat far_zt = VMIN(far_z, NODE(t_max));
    NFloat last = VMIN(far_xy, far_zt);
    *entry = first;
    return node_mask_bits(first <= last * SLAB_PADDING);
}

/// How many triangles a leaf holds, given its reference, and their rows.
static inline uint leaf_triangles(GLOBAL const float* leaves, uint reference,
                                  GLOBAL const float** rows) {
    *rows = leaves + LEAF_ROWS * (reference & BVH_FIRST_MASK);
    return (reference >> BVH_COUNT_SHIFT) & BVH_COUNT_MASK;
}

/// Id of triangle `i` of a leaf.
static inline uint leaf_id(GLOBAL const float* rows, uint count, uint i) {
    return as_bits(rows[LEAF_ID_ROW * count + i]) & LEAF_ID_MASK;
}

/// The triangles of a leaf; replaces `best` by the rule above.
static inline void closest_in_leaf(GLOBAL const float* leaves, uint reference, const Ray* ray,
                                   Hit* best) {
    GLOBAL const float* rows;
    uint count = leaf_triangles(leaves, reference, &rows);
    LeafHits hits;
    uint bits = intersect_triangles(ray, rows, count, best->t, &hits);
    if (bits == 0u) return;
    float t[NODE_WIDTH], v[NODE_WIDTH], w[NODE_WIDTH];
    node_store(hits.t, t);
    node_store(hits.v, v);
    node_store(hits.w, w);
    while (bits != 0u) {
        uint i = lowest_bit(bits);
        bits &= bits - 1u;
        if (t[i] > best->t) continue;
        uint id = leaf_id(rows, count, i);
        if (t[i] == best->t && id >= best->triangle) continue;
        best->triangle = id;
        best->t = t[i];
        best->u = v[i];
        best->v = w[i];
    }
}

/// Asks for the memory of a child ahead of its test.
static inline void prefetch_child(GLOBAL const BvhNode* nodes, GLOBAL const float* leaves,
                                  uint reference) {
    if ((reference & BVH_LEAF) == 0u) {
        GLOBAL const BvhNode* node = nodes + reference;
        PREFETCH(node->bounds[0]);
        PREFETCH(node->bounds[2]);
        PREFETCH(node->bounds[4]);
        PREFETCH(node->child);
    } else {
        GLOBAL const float* rows = leaves + LEAF_ROWS * (reference & BVH_FIRST_MASK);
        PREFETCH(rows);
        PREFETCH(rows + 16);
        PREFETCH(rows + 32);
    }
}

/// Closest hit of the ray within (0, t_max].
static inline Hit bvh_closest(GLOBAL const BvhNode* nodes, GLOBAL const float* leaves,
                              float3 origin, float3 direction, float t_max) {
    uint stack[BVH_STACK];
    float stack_entry[BVH_STACK];
    float entries[NODE_WIDTH];
    Ray ray = make_ray(origin, direction);
    Hit best;
    best.triangle = INVALID_INDEX;
    best.t = t_max;
    best.u = 0.0f;
    best.v = 0.0f;
    uint size = 0u;
    uint reference = 0u;
    for (;;) {
        if ((reference & BVH_LEAF) == 0u) {
            GLOBAL const BvhNode* node = nodes + reference;
            NFloat entry;
            uint bits = intersect_node(node, &ray.slabs, best.t, &entry);
            if (bits != 0u) {
                uint child = lowest_bit(bits);
                bits &= bits - 1u;
                reference = node->child[child];
                if (bits == 0u) continue;
                // The nearest child stays in `reference`; the others wait, the nearer on top.
                node_store(entry, entries);
                float nearest = entries[child];
                uint base = size;
                while (bits != 0u) {
                    child = lowest_bit(bits);
                    bits &= bits - 1u;
                    uint later = node->child[child];
                    float distance = entries[child];
                    if (distance < nearest) {
                        uint swap = reference;
                        reference = later;
                        later = swap;
                        float swap_distance = nearest;
                        nearest = distance;
                        distance = swap_distance;
                    }
                    uint place = size++;
                    while (place > base && stack_entry[place - 1u] < distance) {
                        stack[place] = stack[place - 1u];
                        stack_entry[place] = stack_entry[place - 1u];
                        --place;
                    }
                    stack[place] = later;
                    stack_entry[place] = distance;
                    prefetch_child(nodes, leaves, later);
                }
                continue;
            }
        } else {
            closest_in_leaf(leaves, reference, &ray, &best);
        }
        do {
            if (size == 0u) return best;
            --size;
        } while (stack_entry[size] > best.t * SLAB_PADDING);
        reference = stack[size];
    }
}

/// 1 where anything lies within (0, t_max) of the ray, else 0.
static inline int bvh_any(GLOBAL const BvhNode* nodes, GLOBAL const float* leaves, float3 origin,
                          float3 direction, float t_max) {
    uint stack[BVH_STACK];
    Ray ray = make_ray(origin, direction);
    float last = from_bits(as_bits(t_max) - 1u);  // the largest distance before t_max
    uint size = 1u;
    stack[0] = 0u;
    while (size > 0u) {
        GLOBAL const BvhNode* node = nodes + stack[--size];
        NFloat entry;
        uint bits = intersect_node(node, &ray.slabs, t_max, &entry);
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
            LeafHits hits;
            if (intersect_triangles(&ray, rows, count, last, &hits) != 0u) return 1;
        }
    }
    return 0;
}

#endif
