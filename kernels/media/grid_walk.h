// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The way of a ray through a lattice of cubes: of a density grid's blocks, or of its voxels
// (Amanatides and Woo 1987).
#ifndef WEFT_KERNELS_MEDIA_GRID_WALK_H
#define WEFT_KERNELS_MEDIA_GRID_WALK_H

#include "kernels/core/vector.h"
#include "kernels/media/density_grid.h"

/// The part of a ray that lies in a grid. Its parameter s is 0 where that part begins, so that a
/// ray from far away loses no accuracy inside.
typedef struct {
    float3 origin;     // in voxels, at s = 0
    float3 direction;  // in voxels, for each unit of s
    float first;       // the ray's own parameter at s = 0
    float length;      // s at the end; finite and above 0
} GridRay;

/// Clips [*first, *last] to where origin + t direction lies in [0, 1]; *last < *first for nowhere.
static inline void clip_to_unit(float origin, float direction, float* first, float* last) {
    if (direction == 0.0f) {
        // Divided by 0, an origin on a face would be NaN.
        if (!(origin >= 0.0f && origin <= 1.0f)) *last = -M_INFINITY;
        return;
    }
    float low = -origin / direction;
    float high = (1.0f - origin) / direction;
    *first = m_max(m_min(low, high), *first);
    *last = m_min(m_max(low, high), *last);
}

/// Whether origin + t direction, in the unit cube's space, meets the grid for first < t < last, and
/// where. `last` may be infinite. Rays that touch the cube in a point do not meet it, nor does one
/// with numbers that are not finite.
static inline int enter_grid(const DensityGrid* grid, float3 origin, float3 direction, float first,
                             float last, GridRay* ray) {
    float3 size = f3((float)grid->record.nx, (float)grid->record.ny, (float)grid->record.nz);
    clip_to_unit(origin.x, direction.x, &first, &last);
    clip_to_unit(origin.y, direction.y, &first, &last);
    clip_to_unit(origin.z, direction.z, &first, &last);
    ray->first = first;
    ray->length = last - first;
    ray->direction = direction * size;
    float3 p = origin + direction * first;
    ray->origin =
        f3(m_clamp(p.x, 0.0f, 1.0f), m_clamp(p.y, 0.0f, 1.0f), m_clamp(p.z, 0.0f, 1.0f)) * size;
    if (!(ray->length > 0.0f && ray->length < M_INFINITY)) return 0;
    return is_finite3(p) && is_finite3(ray->direction) ? 1 : 0;
}

/// Where a ray is for a parameter s, in voxels.
static inline float3 grid_ray_at(const GridRay* ray, float s) {
    return ray->origin + ray->direction * s;
}

/// A walk through the cells of a lattice, one after the other. It is in cell (x, y, z) for s in
/// [start, end].
typedef struct {
    float3 origin, direction;  // in cells
    float3 next;               // s at which it leaves the cell along each axis
    float start, end, length;
    int x, y, z;
} CellWalk;

/// s at which a walk leaves cell `index` of an axis.
static inline float leaves_cell(int index, float origin, float direction) {
    if (direction == 0.0f) return M_INFINITY;
    return ((float)(direction > 0.0f ? index + 1 : index) - origin) / direction;
}

static inline void end_cell(CellWalk* walk) {
    walk->end = m_min(m_max(min_component(walk->next), walk->start), walk->length);
}

/// A walk for s in [start, length] from `origin` at s = 0, both in cells and finite.
static inline CellWalk start_cells(float3 origin, float3 direction, float start, float length) {
    CellWalk walk;
    walk.origin = origin;
    walk.direction = direction;
    walk.start = start;
    walk.length = length;
    float3 p = origin + direction * start;
    walk.x = (int)m_floor(p.x);
    walk.y = (int)m_floor(p.y);
    walk.z = (int)m_floor(p.z);
    walk.next.x = leaves_cell(walk.x, origin.x, direction.x);
    walk.next.y = leaves_cell(walk.y, origin.y, direction.y);
    walk.next.z = leaves_cell(walk.z, origin.z, direction.z);
    end_cell(&walk);
    return walk;
}

/// Goes on to the next cell; 0 where the walk has come to its end.
static inline int next_cell(CellWalk* walk) {
    if (!(walk->end < walk->length)) return 0;
    walk->start = walk->end;
    if (walk->next.x <= walk->next.y && walk->next.x <= walk->next.z) {
        walk->x += walk->direction.x > 0.0f ? 1 : -1;
        walk->next.x = leaves_cell(walk->x, walk->origin.x, walk->direction.x);
    } else if (walk->next.y <= walk->next.z) {
        walk->y += walk->direction.y > 0.0f ? 1 : -1;
        walk->next.y = leaves_cell(walk->y, walk->origin.y, walk->direction.y);
    } else {
        walk->z += walk->direction.z > 0.0f ? 1 : -1;
        walk->next.z = leaves_cell(walk->z, walk->origin.z, walk->direction.z);
    }
    end_cell(walk);
    return 1;
}

/// The blocks of a grid along a ray.
static inline CellWalk start_blocks(const DensityGrid* grid, const GridRay* ray) {
    float share = 1.0f / (float)grid->record.block;  // exact: a power of two
    return start_cells(ray->origin * share, ray->direction * share, 0.0f, ray->length);
}

/// The bound of the block that a walk is in.
static inline float walk_bound(const DensityGrid* grid, const CellWalk* walk) {
    return block_bound(grid, walk->x, walk->y, walk->z);
}

#endif
