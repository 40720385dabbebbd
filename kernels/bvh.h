// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Traversal of the wide BVH by single rays. A closest hit does not depend on the tree: of equally
// distant triangles the one with the smallest id wins.
#ifndef WEFT_BVH_H
#define WEFT_BVH_H

#include "triangle.h"

// Covers the rounding of the slab test (Ize, JCGT 2013): at least 1 + 2 gamma(3).
#define SLAB_PADDING 1.0000005f

/// Which children the ray meets within (0, t_max]; `entry` receives their entry distances.
static inline uint intersect_node(GLOBAL const BvhNode* node, const Ray* ray, float t_max,
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

/// The triangles of a leaf; replaces `best` by the rule above.
static inline void intersect_leaf(GLOBAL const BvhTriangle* triangles, uint reference,
                                  const Ray* ray, Hit* best) {
    uint first = reference & BVH_FIRST_MASK;
    uint end = first + ((reference >> BVH_COUNT_SHIFT) & BVH_COUNT_MASK);
    for (uint i = first; i < end; ++i) {
        GLOBAL const BvhTriangle* triangle = triangles + i;
        Hit hit;
        if (intersect_triangle(ray, coordinates(&triangle->v0), coordinates(&triangle->v1),
                               coordinates(&triangle->v2), best->t, &hit) == 0)
            continue;
        uint id = as_bits(triangle->v0.w);
        if (hit.t < best->t || id < best->triangle) {
            *best = hit;
            best->triangle = id;
        }
    }
}

/// Closest hit of the ray within (0, t_max].
static inline Hit bvh_closest(GLOBAL const BvhNode* nodes, GLOBAL const BvhTriangle* triangles,
                              float3 origin, float3 direction, float t_max) {
    uint stack[BVH_STACK];
    float stack_entry[BVH_STACK];
    float entries[NODE_WIDTH];
    Ray ray = make_ray(origin, direction);
    Hit best;
    best.triangle = NO_TRIANGLE;
    best.t = t_max;
    best.u = 0.0f;
    best.v = 0.0f;
    uint size = 0u;
    uint reference = 0u;
    for (;;) {
        if ((reference & BVH_LEAF) == 0u) {
            GLOBAL const BvhNode* node = nodes + reference;
            NFloat entry;
            uint bits = intersect_node(node, &ray, best.t, &entry);
            node_store(entry, entries);
            uint base = size;
            while (bits != 0u) {
                uint child = lowest_bit(bits);
                bits &= bits - 1u;
                float distance = entries[child];
                uint place = size;
                // Insertion keeps the nearest child on top of the stack.
                while (place > base && stack_entry[place - 1u] < distance) {
                    stack[place] = stack[place - 1u];
                    stack_entry[place] = stack_entry[place - 1u];
                    --place;
                }
                stack[place] = node->child[child];
                stack_entry[place] = distance;
                ++size;
            }
            if (size > base) {
                reference = stack[--size];
                continue;
            }
        } else {
            intersect_leaf(triangles, reference, &ray, &best);
        }
        do {
            if (size == 0u) return best;
            --size;
        } while (stack_entry[size] > best.t * SLAB_PADDING);
        reference = stack[size];
    }
}

/// 1 where anything lies within (0, t_max) of the ray, else 0.
static inline int bvh_any(GLOBAL const BvhNode* nodes, GLOBAL const BvhTriangle* triangles,
                          float3 origin, float3 direction, float t_max) {
    uint stack[BVH_STACK];
    Ray ray = make_ray(origin, direction);
    uint size = 1u;
    stack[0] = 0u;
    while (size > 0u) {
        GLOBAL const BvhNode* node = nodes + stack[--size];
        NFloat entry;
        uint bits = intersect_node(node, &ray, t_max, &entry);
        while (bits != 0u) {
            uint reference = node->child[lowest_bit(bits)];
            bits &= bits - 1u;
            if ((reference & BVH_LEAF) == 0u) {
                stack[size++] = reference;
                continue;
            }
            uint first = reference & BVH_FIRST_MASK;
            uint end = first + ((reference >> BVH_COUNT_SHIFT) & BVH_COUNT_MASK);
            for (uint i = first; i < end; ++i) {
                GLOBAL const BvhTriangle* triangle = triangles + i;
                Hit hit;
                if (intersect_triangle(&ray, coordinates(&triangle->v0), coordinates(&triangle->v1),
                                       coordinates(&triangle->v2), t_max, &hit) != 0 &&
                    hit.t < t_max)
                    return 1;
            }
        }
    }
    return 0;
}

#endif
