// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Ray queries of the native kernels: Embree, or the kernels' own BVH where the scene holds no
// Embree handle. Embree only finds the triangle; distance and barycentrics come from the same
// test as on OpenCL, so that the points of equal triangles are equal bit for bit.
#ifndef WEFT_KERNELS_BVH_TRACE_NATIVE_H
#define WEFT_KERNELS_BVH_TRACE_NATIVE_H

#define SCENE_ARGUMENTS const ::weft::NativeScene* native_scene
#define SCENE_MAKE(name) Scene name = *native_scene

typedef const ::weft::NativeScene& Scene;

/// The kernels' own BVH, where the scene holds no Embree handle.
static inline const BvhNode* own_nodes(Scene scene) {
    return static_cast<const BvhNode*>(scene.bvh_nodes);
}

/// Its leaves; see LEAF_ROWS.
static inline const float* own_leaves(Scene scene) {
    return static_cast<const float*>(scene.bvh_leaves);
}

// Most equally distant triangles that are tested for one ray.
#define MAX_TIES 32

/// The kernels' own test of one triangle, replacing `best` by the rule of bvh_closest.
static inline void retest(Scene scene, const Ray* ray, uint id, Hit* best) {
    const float4* positions = static_cast<const float4*>(scene.positions);
    const Triangle triangle = static_cast<const Triangle*>(scene.triangles)[id];
    const uint vertices[3] = {triangle.v0, triangle.v1, triangle.v2};
    float leaf[LEAF_ROWS + NODE_WIDTH] = {};
    for (uint i = 0; i < 3u; ++i) {
        leaf[3u * i] = positions[vertices[i]].x;
        leaf[3u * i + 1u] = positions[vertices[i]].y;
        leaf[3u * i + 2u] = positions[vertices[i]].z;
    }
    leaf[LEAF_ID_ROW] = from_bits(id | LEAF_ID_FLAG);
    closest_in_leaf(leaf, BVH_LEAF | 1u << BVH_COUNT_SHIFT, ray, best);
}

/// Closest hit by Embree. Coincident faces and shared edges would be decided by the shape of its
/// tree, so all triangles within rounding of the hit are tested and the smallest id wins, as in
/// bvh_closest.
static inline Hit embree_closest_by_id(Scene scene, float3 origin, float3 direction, float t_max) {
    const ::weft::EmbreeHit found =
        ::weft::embree_closest(scene.embree, &origin.x, &direction.x, t_max);
    Hit embree = {found.triangle, found.t, found.u, found.v};
    if (found.triangle == INVALID_INDEX) return embree;
    const float reach = 1.52587890625e-5f;  // 2^-16, far above the difference of the two tests
    uint ties[MAX_TIES];
    const uint count =
        ::weft::embree_candidates(scene.embree, &origin.x, &direction.x, found.t * (1.0f - reach),
                                  found.t * (1.0f + reach), ties, MAX_TIES);
    const Ray ray = make_ray(origin, direction);
    Hit best = {INVALID_INDEX, t_max, 0.0f, 0.0f};
    retest(scene, &ray, found.triangle, &best);
    for (uint i = 0; i < count; ++i) retest(scene, &ray, ties[i], &best);
    // A ray through an edge that only Embree's arithmetic puts inside keeps Embree's hit.
    return best.triangle == INVALID_INDEX ? embree : best;
}

static inline Hit trace_closest(Scene scene, float3 origin, float3 direction, float t_max) {
    if (scene.embree == nullptr)
        return bvh_closest(own_nodes(scene), own_leaves(scene), origin, direction, t_max);
    return embree_closest_by_id(scene, origin, direction, t_max);
}

static inline void trace_closest_packet(Scene scene, float3 origin,
                                        const PacketDirections* directions, uint active,
                                        float t_max, Hit* hits) {
    if (scene.embree == nullptr && LANES > 1) {
        ClosestPacket state;
        bvh_closest_packet(own_nodes(scene), own_leaves(scene), origin, directions, active, t_max,
                           &state);
        for (uint lane = 0u; lane < LANES; ++lane) hits[lane] = lane_hit(&state, lane);
        return;
    }
    const Hit none = {INVALID_INDEX, 0.0f, 0.0f, 0.0f};
    for (uint lane = 0u; lane < LANES; ++lane)
        hits[lane] =
            (active >> lane & 1u) == 0u
                ? none
                : trace_closest(scene, origin,
                                f3(directions->x[lane], directions->y[lane], directions->z[lane]),
                                t_max);
}

static inline int trace_any(Scene scene, float3 origin, float3 direction, float t_max) {
    if (scene.embree == nullptr)
        return bvh_any(own_nodes(scene), own_leaves(scene), origin, direction, t_max);
    return ::weft::embree_any(scene.embree, &origin.x, &direction.x, t_max) ? 1 : 0;
}

static inline WMask trace_any_packet(Scene scene, float3 origin, WFloat3 d, WMask active) {
    if (scene.embree == nullptr)
        return bvh_any_packet(own_nodes(scene), own_leaves(scene), origin, d, active);
    alignas(64) float directions[3 * LANES];
    alignas(64) int lanes[LANES];
    wide_store(d.x, directions, 0);
    wide_store(d.y, directions, LANES);
    wide_store(d.z, directions, 2 * LANES);
    const WMask valid = SELECT(active, mask_none_set - 1, mask_none_set);
    __builtin_memcpy(lanes, &valid, sizeof(lanes));
    ::weft::embree_any_packet(scene.embree, &origin.x, directions, lanes, LANES);
    WMask occluded;
    __builtin_memcpy(&occluded, lanes, sizeof(lanes));
#if LANES == 1
    occluded = occluded != 0 ? 1 : 0;
#endif
    return active & occluded;
}

#endif
