// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Media whose extinction and emission are those of their record times the density of a grid, and
// nothing outside of it. Rays are given in kernel space and walked in the unit cube of the grid,
// where their parameter is the same.
#ifndef WEFT_KERNELS_MEDIA_GRID_MEDIA_H
#define WEFT_KERNELS_MEDIA_GRID_MEDIA_H

#include "kernels/media/grid_tracking.h"

/// A ray in the unit cube's space of a grid.
typedef struct {
    float3 origin, direction;
} CubeRay;

static inline CubeRay ray_in_cube(const DensityGrid* grid, float3 origin, float3 direction) {
    CubeRay ray;
    ray.origin = point_in_cube(grid, origin);
    ray.direction = direction_in_cube(grid, direction);
    return ray;
}

/// The density at a place.
static inline float density_at_place(const DensityGrid* grid, float3 place) {
    return density_at(grid, point_in_cube(grid, place));
}

/// An unbiased estimate of the medium's transmittance between `first` and `last` of a ray.
static inline float3 tracked_transmittance(const DensityGrid* grid, float3 sigma_t, float3 origin,
                                           float3 direction, float first, float last,
                                           Random* random) {
    CubeRay ray = ray_in_cube(grid, origin, direction);
    return grid_transmittance(grid, ray.origin, ray.direction, first, last, sigma_t, random);
}

/// The integral of the density over the first `length` of a ray, but no more than `most` > 0. It is
/// exact but for rounding; see grid_depth_up_to.
static inline float depth_on_way(const DensityGrid* grid, float3 origin, float3 direction,
                                 float length, float most) {
    CubeRay ray = ray_in_cube(grid, origin, direction);
    return grid_depth_up_to(grid, ray.origin, ray.direction, 0.0f, length, most);
}

#endif
