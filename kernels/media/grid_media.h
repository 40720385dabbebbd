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

/// The density of each channel at a place, where it is `greatest` in the greatest one.
static inline float3 colour_at_place(const DensityGrid* grid, float3 place, float greatest) {
    if (grid->record.channels != 3u) return f3(greatest, greatest, greatest);
    float3 size = f3((float)grid->record.nx, (float)grid->record.ny, (float)grid->record.nz);
    return colour_inside(grid, point_in_cube(grid, place) * size, greatest) * greatest;
}

/// The nearest place of the unit cube, in voxels.
static inline float3 voxels_in_cube(const DensityGrid* grid, float3 place) {
    float3 p = point_in_cube(grid, place);
    float3 size = f3((float)grid->record.nx, (float)grid->record.ny, (float)grid->record.nz);
    return f3(m_clamp(p.x, 0.0f, 1.0f), m_clamp(p.y, 0.0f, 1.0f), m_clamp(p.z, 0.0f, 1.0f)) * size;
}

/// The albedo at a place of a grid of albedos, whose outermost voxels go on outside of it.
static inline float3 albedo_in_grid(const DensityGrid* grid, float3 place) {
    float3 p = voxels_in_cube(grid, place);
    DensityGrid red = grid_plane(grid, 0u);
    float first = density_inside(&red, p);
    if (grid->record.channels != 3u) return f3(first, first, first);
    DensityGrid green = grid_plane(grid, 1u);
    DensityGrid blue = grid_plane(grid, 2u);
    return f3(first, density_inside(&green, p), density_inside(&blue, p));
}

/// An unbiased estimate of the medium's transmittance between `first` and `last` of a ray.
static inline float3 tracked_transmittance(const DensityGrid* grid, float3 sigma_t, float3 origin,
                                           float3 direction, float first, float last,
                                           Random* random) {
    CubeRay ray = ray_in_cube(grid, origin, direction);
    return grid_transmittance(grid, ray.origin, ray.direction, first, last, sigma_t, random);
}

/// The integrals of the density of each channel over the first `length` of a ray.
static inline float3 channel_depths_on_way(const DensityGrid* grid, float3 origin, float3 direction,
                                           float length) {
    CubeRay ray = ray_in_cube(grid, origin, direction);
    GridRay inside;
    if (enter_grid(grid, ray.origin, ray.direction, 0.0f, length, &inside) == 0)
        return f3(0.0f, 0.0f, 0.0f);
    return channel_depths(grid, &inside, 0.0f, inside.length);
}

/// The integral of the density over the first `length` of a ray, but no more than `most` > 0. It is
/// exact but for rounding; see grid_depth_up_to.
static inline float depth_on_way(const DensityGrid* grid, float3 origin, float3 direction,
                                 float length, float most) {
    CubeRay ray = ray_in_cube(grid, origin, direction);
    return grid_depth_up_to(grid, ray.origin, ray.direction, 0.0f, length, most);
}

#endif
