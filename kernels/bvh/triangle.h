// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Rays, and the watertight ray/triangle test of Woop, Benthin and Wald (JCGT 2013) for all
// triangles of a leaf at once.
#ifndef WEFT_KERNELS_BVH_TRIANGLE_H
#define WEFT_KERNELS_BVH_TRIANGLE_H

#include "kernels/core/maths.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"
#include "kernels/core/vector.h"

// Largest finite distance; rays "to infinity" end here.
#define RAY_INFINITY 3.0e38f

// A closest hit: p = (1 - u - v) v0 + u v1 + v v2. `triangle` is INVALID_INDEX for a miss.
typedef struct {
    uint triangle;
    float t, u, v;
} Hit;

// What the slab test needs of a ray.
typedef struct {
    float3 origin, inverse;    // inverse: reciprocals of the direction, always finite
    uint far_x, far_y, far_z;  // 0 where the upper plane of the axis is the far one, else 1
} SlabRay;

// A ray with what the slab and triangle tests need of its direction.
typedef struct {
    SlabRay slabs;
    uint axis_x, axis_y, axis_z;  // the shear's axes; z is the direction's largest component
    float shear_x, shear_y, shear_z;
    float start_x, start_y, start_z;  // origin along them
} Ray;

static inline float component(float3 v, uint axis) {
    return axis == 0u ? v.x : (axis == 1u ? v.y : v.z);
}

/// `d`, or +-`smallest` with the sign of `d` where it is nearer to zero than that.
static inline float away_from_zero(float d, float smallest) {
    if (absolute(d) >= smallest) return d;
    return (as_bits(d) >> 31) != 0u ? -smallest : smallest;
}

/// The slab test's view of a ray with these reciprocals.
static inline SlabRay make_slab_ray(float3 origin, float3 inverse) {
    SlabRay slabs;
    slabs.origin = origin;
    slabs.inverse = inverse;
    slabs.far_x = inverse.x < 0.0f ? 1u : 0u;
    slabs.far_y = inverse.y < 0.0f ? 1u : 0u;
    slabs.far_z = inverse.z < 0.0f ? 1u : 0u;
    return slabs;
}

/// A ray from `origin` along `direction`, whose largest component is 1e-20 to 1e20. No NaN can
/// arise in slab tests: components below 1e-18 of the largest are moved away from zero.
static inline Ray make_ray(float3 origin, float3 direction) {
    Ray ray;
    float3 size = f3(absolute(direction.x), absolute(direction.y), absolute(direction.z));
    float smallest = m_max(size.x, m_max(size.y, size.z)) * 1.0e-18f;
    ray.slabs = make_slab_ray(origin, f3(1.0f / away_from_zero(direction.x, smallest),
                                         1.0f / away_from_zero(direction.y, smallest),
                                         1.0f / away_from_zero(direction.z, smallest)));
    ray.axis_z = size.x > size.y ? (size.x > size.z ? 0u : 2u) : (size.y > size.z ? 1u : 2u);
    ray.axis_x = ray.axis_z == 2u ? 0u : ray.axis_z + 1u;
    ray.axis_y = ray.axis_x == 2u ? 0u : ray.axis_x + 1u;
    float along = component(direction, ray.axis_z);
    if (along < 0.0f) {
        uint swap = ray.axis_x;
        ray.axis_x = ray.axis_y;
        ray.axis_y = swap;
    }
    ray.shear_x = component(direction, ray.axis_x) / along;
    ray.shear_y = component(direction, ray.axis_y) / along;
    ray.shear_z = component(ray.slabs.inverse, ray.axis_z);
    ray.start_x = component(origin, ray.axis_x);
    ray.start_y = component(origin, ray.axis_y);
    ray.start_z = component(origin, ray.axis_z);
    return ray;
}

// Hits of the triangles of a leaf, in order; `v` and `w` weigh the second and third vertex.
typedef struct {
    NFloat t, v, w;
} LeafHits;

/// Tests a leaf of `count` triangles (see LEAF_ROWS). Edges and vertices belong to every triangle
/// that has them, so nothing slips between neighbours. Returns one bit for each triangle that is
/// hit with 0 < t <= t_max, the first in bit 0; `hits` holds numbers for those alone.
static inline uint intersect_triangles(const Ray* ray, GLOBAL const float* rows, uint count,
                                       float t_max, LeafHits* hits) {
    GLOBAL const float* x = rows + ray->axis_x * count;
    GLOBAL const float* y = rows + ray->axis_y * count;
    GLOBAL const float* z = rows + ray->axis_z * count;
    uint vertex = 3u * count;
    NFloat az = node_load(z) - ray->start_z;
    NFloat bz = node_load(z + vertex) - ray->start_z;
    NFloat cz = node_load(z + 2u * vertex) - ray->start_z;
    NFloat ax = node_load(x) - ray->start_x - az * ray->shear_x;
    NFloat ay = node_load(y) - ray->start_y - az * ray->shear_y;
    NFloat bx = node_load(x + vertex) - ray->start_x - bz * ray->shear_x;
    NFloat by = node_load(y + vertex) - ray->start_y - bz * ray->shear_y;
    NFloat cx = node_load(x + 2u * vertex) - ray->start_x - cz * ray->shear_x;
    NFloat cy = node_load(y + 2u * vertex) - ray->start_y - cz * ray->shear_y;
    NFloat u = cx * by - cy * bx;
    NFloat v = ax * cy - ay * cx;
    NFloat w = bx * ay - by * ax;
    NFloat zero = NODE(0.0f);
    NFloat determinant = u + v + w;
    NFloat uv_lowest = VMIN(u, v);
    NFloat uv_highest = VMAX(u, v);
    NFloat lowest = VMIN(uv_lowest, w);
    NFloat highest = VMAX(uv_highest, w);
    NMask inside = ((lowest >= zero) | (highest <= zero)) & (determinant != zero);
    uint bits = node_mask_bits(inside) & ((1u << count) - 1u);
    if (bits == 0u) return 0u;
    // Weights first: the products of tiny triangles would underflow.
    NFloat weight_v = v / determinant;
    NFloat weight_w = w / determinant;
    NFloat t = (u / determinant * az + weight_v * bz + weight_w * cz) * ray->shear_z;
    hits->t = t;
    hits->v = weight_v;
    hits->w = weight_w;
    return bits & node_mask_bits((t > zero) & (t <= NODE(t_max)));
}

#endif
