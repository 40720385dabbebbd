// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Integrals of a grid's density along a ray, without random numbers: between the centres of voxels
// a trilinear density is a cubic polynomial along any line, which Simpson's rule integrates
// exactly.
#ifndef WEFT_KERNELS_MEDIA_GRID_DEPTH_H
#define WEFT_KERNELS_MEDIA_GRID_DEPTH_H

#include "kernels/media/grid_walk.h"

/// Simpson's rule over [start, end], of densities there and in the middle. The weights come first,
/// so that no sum of finite densities overflows by much, and none is multiplied with 0.
static inline float simpson(float start, float end, float first, float middle, float last) {
    if (!(end > start)) return 0.0f;
    return (end - start) * (first * 0.16666667f + middle * 0.66666667f + last * 0.16666667f);
}

static inline float density_on_ray(const DensityGrid* grid, const GridRay* ray, float s) {
    return density_inside(grid, grid_ray_at(ray, s));
}

/// The integral over [start, end], which lies between voxels' centres.
static inline float depth_between(const DensityGrid* grid, const GridRay* ray, float start,
                                  float end) {
    float first = density_on_ray(grid, ray, start);
    float middle = density_on_ray(grid, ray, 0.5f * (start + end));
    return simpson(start, end, first, middle, density_on_ray(grid, ray, end));
}

/// Where in [start, end], which lies between voxels' centres, the integral from start is `depth`.
static inline float depth_reached_at(const DensityGrid* grid, const GridRay* ray, float start,
                                     float end, float depth) {
    float low = start;
    float high = end;
    for (int i = 0; i < 24; ++i) {
        float middle = 0.5f * (low + high);
        if (depth_between(grid, ray, start, middle) < depth) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

/// Adds to *depth the integral of the density over [start, end] of a ray, until it is `target`.
/// Returns where it ended.
static inline float add_depth(const DensityGrid* grid, const GridRay* ray, float start, float end,
                              float target, float* depth) {
    float3 half_voxel = f3(0.5f, 0.5f, 0.5f);
    CellWalk cell = start_cells(ray->origin - half_voxel, ray->direction, start, end);
    float last = density_on_ray(grid, ray, start);
    do {
        float first = last;
        float middle = density_on_ray(grid, ray, 0.5f * (cell.start + cell.end));
        last = density_on_ray(grid, ray, cell.end);
        float part = simpson(cell.start, cell.end, first, middle, last);
        if (*depth + part >= target) {
            float s = depth_reached_at(grid, ray, cell.start, cell.end, target - *depth);
            *depth = target;
            return s;
        }
        *depth += part;
    } while (next_cell(&cell) != 0);
    return end;
}

/// The integral of the density over s in [start, length], but no more than `target` > 0. *stop is
/// where that was reached, `length` where it was not.
static inline float density_integral(const DensityGrid* grid, const GridRay* ray, float start,
                                     float target, float* stop) {
    float depth = 0.0f;
    CellWalk block = start_blocks(grid, ray);
    *stop = ray->length;
    do {
        float from = m_max(block.start, start);
        if (from < block.end && walk_bound(grid, &block) > 0.0f) {
            float s = add_depth(grid, ray, from, block.end, target, &depth);
            if (depth >= target) {
                *stop = s;
                return target;
            }
        }
    } while (next_cell(&block) != 0);
    return depth;
}

/// The integral of the density along origin + t direction, first < t < last, in the unit cube's
/// space, but no more than `most` > 0: times the extinction for density 1 and each unit of t it is
/// the optical depth. Exact but for rounding, at the cost of a few look-ups for each voxel that the
/// ray passes.
static inline float grid_depth_up_to(const DensityGrid* grid, float3 origin, float3 direction,
                                     float first, float last, float most) {
    GridRay ray;
    float stop;
    if (enter_grid(grid, origin, direction, first, last, &ray) == 0) return 0.0f;
    return density_integral(grid, &ray, 0.0f, most, &stop);
}

/// The same without an upper bound.
static inline float grid_depth(const DensityGrid* grid, float3 origin, float3 direction,
                               float first, float last) {
    return grid_depth_up_to(grid, origin, direction, first, last, M_INFINITY);
}

#endif
