// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Ray queries: the one thing besides the launch loop that differs between backends. A kernel that
// TRACES makes a Scene of its arguments with SCENE_MAKE, and hands it to trace_*.
#ifndef WEFT_KERNELS_BVH_TRACE_H
#define WEFT_KERNELS_BVH_TRACE_H

#include "kernels/bvh/bvh.h"
#include "kernels/bvh/bvh_packet.h"
#include "kernels/bvh/bvh_packet_closest.h"

#ifdef __cplusplus
#include "kernels/bvh/trace_native.h"
#else

#define SCENE_ARGUMENTS GLOBAL const BvhNode *bvh_nodes, GLOBAL const float *bvh_leaves
#define SCENE_MAKE(name)    \
    Scene name;             \
    name.nodes = bvh_nodes; \
    name.leaves = bvh_leaves

typedef struct {
    GLOBAL const BvhNode* nodes;
    GLOBAL const float* leaves;
} Scene;

/// The kernels' own BVH.
static inline GLOBAL const BvhNode* own_nodes(Scene scene) {
    return scene.nodes;
}

/// Its leaves; see LEAF_ROWS.
static inline GLOBAL const float* own_leaves(Scene scene) {
    return scene.leaves;
}

/// Closest hit within (0, t_max]; of equally distant triangles the smallest id.
static inline Hit trace_closest(Scene scene, float3 origin, float3 direction, float t_max) {
    return bvh_closest(scene.nodes, scene.leaves, origin, direction, t_max);
}

/// 1 where anything lies within (0, t_max), else 0.
static inline int trace_any(Scene scene, float3 origin, float3 direction, float t_max) {
    return bvh_any(scene.nodes, scene.leaves, origin, direction, t_max);
}

/// Lanes of `active` whose segment from `origin` to `origin + d` is blocked before SHADOW_END.
static inline WMask trace_any_packet(Scene scene, float3 origin, WFloat3 d, WMask active) {
    return bvh_any_packet(scene.nodes, scene.leaves, origin, d, active);
}

/// Closest hits within (0, t_max] of rays from one point, for the lanes of `active`.
static inline void trace_closest_packet(Scene scene, float3 origin,
                                        const PacketDirections* directions, uint active,
                                        float t_max, Hit* hits) {
#if LANES == 1
    if (active != 0u)
        hits[0] = bvh_closest(scene.nodes, scene.leaves, origin,
                              f3(directions->x[0], directions->y[0], directions->z[0]), t_max);
#else
    ClosestPacket state;
    bvh_closest_packet(scene.nodes, scene.leaves, origin, directions, active, t_max, &state);
    for (uint lane = 0u; lane < LANES; ++lane) hits[lane] = lane_hit(&state, lane);
#endif
}

#endif
#endif
