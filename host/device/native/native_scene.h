// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_NATIVE_SCENE_H
#define WEFT_DEVICE_NATIVE_NATIVE_SCENE_H

namespace weft {

/// The scene in which natively compiled kernels trace. Pointers are untyped, because every kernel
/// variant has its own copy of the shared structs in its own namespace.
struct NativeScene {
    const void* bvh_nodes = nullptr;   ///< BvhNode; null beside Embree until a kernel walks them
    const void* bvh_leaves = nullptr;  ///< float, see LEAF_ROWS
    const void* positions = nullptr;   ///< float4 a vertex
    const void* triangles = nullptr;   ///< Triangle, by id
    void* embree = nullptr;            ///< EmbreeScene; null: rays use the kernels' own BVH
};

/// Closest hit as Embree found it; `triangle` is 0xFFFFFFFF for a miss.
struct EmbreeHit {
    unsigned int triangle;
    float t, u, v;
};

/// Closest hit of a ray within (0, t_max].
EmbreeHit embree_closest(void* scene, const float* origin, const float* direction, float t_max);

/// Finds triangles within [t_from, t_to] of the ray and writes at most `capacity` of their ids to
/// `triangles`, in no promised order. Returns how many.
unsigned int embree_candidates(void* scene, const float* origin, const float* direction,
                               float t_from, float t_to, unsigned int* triangles,
                               unsigned int capacity);

/// Whether the ray hits anything within (0, t_max).
bool embree_any(void* scene, const float* origin, const float* direction, float t_max);

/// Traces shadow rays from one `origin` along `directions` (`width` x, then y, then z components),
/// within (0, SHADOW_END). `lanes` is -1 for lanes to trace and 0 for others; on return it is -1
/// where blocked, else 0. `width` is 1, 4, 8 or 16.
void embree_any_packet(void* scene, const float* origin, const float* directions, int* lanes,
                       int width);

}  // namespace weft

#endif
