// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Rays, and the watertight ray/triangle test of Woop, Benthin and Wald (JCGT 2013).
#ifndef WEFT_TRIANGLE_H
#define WEFT_TRIANGLE_H

#include "maths.h"
#include "port.h"
#include "types.h"
#include "vector.h"

// Largest finite distance; rays "to infinity" end here.
#define RAY_INFINITY 3.0e38f

/// The coordinates of a vertex one by one.
static inline GLOBAL const float* coordinates(GLOBAL const float4* vertex) {
    return (GLOBAL const float*)vertex;
}

// A closest hit: p = (1 - u - v) v0 + u v1 + v v2. `triangle` is NO_TRIANGLE for a miss.
typedef struct {
    uint triangle;
    float t, u, v;
} Hit;

// A ray with what the slab and triangle tests need of its direction.
typedef struct {
    float3 origin, direction, inverse;
    uint far_x, far_y, far_z;     // 0 where the upper plane of the axis is the far one, else 1
    uint axis_x, axis_y, axis_z;  // the shear's axes; z is the direction's largest component
    float shear_x, shear_y, shear_z;
    float start_x, start_y, start_z;  // origin along them
} Ray;

static inline float3 xyz(float4 v) {
    return f3(v.x, v.y, v.z);
}

static inline float component(float3 v, uint axis) {
    return axis == 0u ? v.x : (axis == 1u ? v.y : v.z);
}

/// `d`, or +-`smallest` with the sign of `d` where it is nearer to zero than that.
static inline float away_from_zero(float d, float smallest) {
    if (absolute(d) >= smallest) return d;
    return (as_bits(d) >> 31) != 0u ? -smallest : smallest;
}

/// A ray from `origin` along `direction` (any length but 0). The reciprocal is always finite, so
/// no NaN can arise in slab tests: components below 1e-18 of the largest are moved away from zero.
static inline Ray make_ray(float3 origin, float3 direction) {
    Ray ray;
    float3 size = f3(absolute(direction.x), absolute(direction.y), absolute(direction.z));
    float largest = m_max(size.x, m_max(size.y, size.z));
    float smallest = largest * 1.0e-18f;
    ray.origin = origin;
    ray.direction = direction;
    ray.inverse = f3(1.0f / away_from_zero(direction.x, smallest),
                     1.0f / away_from_zero(direction.y, smallest),
                     1.0f / away_from_zero(direction.z, smallest));
    ray.far_x = ray.inverse.x < 0.0f ? 1u : 0u;
    ray.far_y = ray.inverse.y < 0.0f ? 1u : 0u;
    ray.far_z = ray.inverse.z < 0.0f ? 1u : 0u;
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
    ray.shear_z = 1.0f / along;
    ray.start_x = component(origin, ray.axis_x);
    ray.start_y = component(origin, ray.axis_y);
    ray.start_z = component(origin, ray.axis_z);
    return ray;
}

/// Tests one triangle, given by its vertices' coordinates. Edges and vertices belong to every
/// triangle that has them, so nothing slips between neighbours. On a hit with 0 < t <= t_max fills
/// t, u, v and returns 1.
static inline int intersect_triangle(const Ray* ray, GLOBAL const float* v0, GLOBAL const float* v1,
                                     GLOBAL const float* v2, float t_max, Hit* hit) {
    float az = v0[ray->axis_z] - ray->start_z;
    float bz = v1[ray->axis_z] - ray->start_z;
    float cz = v2[ray->axis_z] - ray->start_z;
    float ax = v0[ray->axis_x] - ray->start_x - ray->shear_x * az;
    float ay = v0[ray->axis_y] - ray->start_y - ray->shear_y * az;
    float bx = v1[ray->axis_x] - ray->start_x - ray->shear_x * bz;
    float by = v1[ray->axis_y] - ray->start_y - ray->shear_y * bz;
    float cx = v2[ray->axis_x] - ray->start_x - ray->shear_x * cz;
    float cy = v2[ray->axis_y] - ray->start_y - ray->shear_y * cz;
    float u = cx * by - cy * bx;
    float v = ax * cy - ay * cx;
    float w = bx * ay - by * ax;
    if ((u < 0.0f || v < 0.0f || w < 0.0f) && (u > 0.0f || v > 0.0f || w > 0.0f)) return 0;
    float determinant = u + v + w;
    if (determinant == 0.0f) return 0;
    // Weights first: the products of tiny triangles would underflow.
    float weight_a = u / determinant;
    float weight_b = v / determinant;
    float weight_c = w / determinant;
    float t = ray->shear_z * (weight_a * az + weight_b * bz + weight_c * cz);
    if (!(t > 0.0f && t <= t_max)) return 0;
    hit->t = t;
    hit->u = weight_b;
    hit->v = weight_c;
    return 1;
}

#endif
