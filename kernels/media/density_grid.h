// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Densities of a medium in the unit cube, trilinear between the centres of voxels, and their
// majorants for blocks of voxels; see host/scene/density_grid.h and majorant_grid.h.
#ifndef WEFT_KERNELS_MEDIA_DENSITY_GRID_H
#define WEFT_KERNELS_MEDIA_DENSITY_GRID_H

#include "kernels/core/maths.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"

/// A grid of at least one voxel. Lengths in a grid are in voxels, from the corner of the cube.
typedef struct {
    GLOBAL const float* densities;  // of the first voxel
    GLOBAL const float* bounds;     // of the first block
    DensityGridRecord record;
} DensityGrid;

/// The grid of a record, of all grids' densities and bounds.
static inline DensityGrid density_grid(DensityGridRecord record, GLOBAL const float* densities,
                                       GLOBAL const float* bounds) {
    DensityGrid grid;
    grid.densities = densities + record.first;
    grid.bounds = bounds + record.first_bound;
    grid.record = record;
    return grid;
}

static inline float row_times(float4 row, float3 v) {
    return row.x * v.x + row.y * v.y + row.z * v.z;
}

/// A direction of kernel space in the space of the unit cube: a ray's parameter is the same in
/// both.
static inline float3 direction_in_cube(const DensityGrid* grid, float3 d) {
    return f3(row_times(grid->record.to_x, d), row_times(grid->record.to_y, d),
              row_times(grid->record.to_z, d));
}

/// A point of kernel space in the space of the unit cube.
static inline float3 point_in_cube(const DensityGrid* grid, float3 p) {
    return direction_in_cube(grid, p) +
           f3(grid->record.to_x.w, grid->record.to_y.w, grid->record.to_z.w);
}

/// Two voxels of an axis and the share of the second.
typedef struct {
    uint low, high;
    float share;
} VoxelPair;

/// The voxels about `x` on an axis of `size`; beyond the outermost centres these alone.
static inline VoxelPair voxels_about(float x, uint size) {
    VoxelPair pair;
    float centre = m_clamp(x - 0.5f, 0.0f, (float)(size - 1u));
    pair.low = (uint)centre;
    // Sizes beyond 2^24 may have been rounded up.
    pair.low = pair.low < size ? pair.low : size - 1u;
    pair.high = pair.low + 1u < size ? pair.low + 1u : pair.low;
    pair.share = m_clamp(centre - (float)pair.low, 0.0f, 1.0f);
    return pair;
}

/// Between a and b; exactly a where both are equal.
static inline float density_between(float a, float b, float share) {
    return a + share * (b - a);
}

/// The density at `p`, in voxels; outside the grid that of the nearest place on its surface.
static inline float density_inside(const DensityGrid* grid, float3 p) {
    uint nx = grid->record.nx;
    uint ny = grid->record.ny;
    VoxelPair x = voxels_about(p.x, nx);
    VoxelPair y = voxels_about(p.y, ny);
    VoxelPair z = voxels_about(p.z, grid->record.nz);
    GLOBAL const float* a = grid->densities + (z.low * ny + y.low) * nx;
    GLOBAL const float* b = grid->densities + (z.low * ny + y.high) * nx;
    GLOBAL const float* c = grid->densities + (z.high * ny + y.low) * nx;
    GLOBAL const float* d = grid->densities + (z.high * ny + y.high) * nx;
    float low = density_between(density_between(a[x.low], a[x.high], x.share),
                                density_between(b[x.low], b[x.high], x.share), y.share);
    float high = density_between(density_between(c[x.low], c[x.high], x.share),
                                 density_between(d[x.low], d[x.high], x.share), y.share);
    return density_between(low, high, z.share);
}

/// The density at `p` of the unit cube; 0 outside, and where a coordinate is NaN.
static inline float density_at(const DensityGrid* grid, float3 p) {
    if (!(p.x >= 0.0f && p.x <= 1.0f)) return 0.0f;
    if (!(p.y >= 0.0f && p.y <= 1.0f)) return 0.0f;
    if (!(p.z >= 0.0f && p.z <= 1.0f)) return 0.0f;
    return density_inside(grid, f3(p.x * (float)grid->record.nx, p.y * (float)grid->record.ny,
                                   p.z * (float)grid->record.nz));
}

/// One channel of a grid whose densities, or albedos, have a colour; `plane` counts what is stored,
/// see DensityGridRecord::channels.
static inline DensityGrid grid_plane(const DensityGrid* grid, uint plane) {
    DensityGrid channel = *grid;
    channel.densities += plane * (grid->record.nx * grid->record.ny * grid->record.nz);
    channel.record.channels = 1u;
    return channel;
}

/// Of a grid whose densities have a colour, the share of the greatest channel, of density
/// `greatest` at `p` in voxels, that each channel has there.
static inline float3 colour_inside(const DensityGrid* grid, float3 p, float greatest) {
    DensityGrid red = grid_plane(grid, 1u);
    DensityGrid green = grid_plane(grid, 2u);
    DensityGrid blue = grid_plane(grid, 3u);
    if (!(greatest > 0.0f)) return f3(0.0f, 0.0f, 0.0f);
    // Interpolated, the greatest of the voxels is no less than any channel.
    return f3(m_min(density_inside(&red, p) / greatest, 1.0f),
              m_min(density_inside(&green, p) / greatest, 1.0f),
              m_min(density_inside(&blue, p) / greatest, 1.0f));
}

static inline uint nearest_block(int index, uint size) {
    return index < 0 ? 0u : ((uint)index < size ? (uint)index : size - 1u);
}

/// The bound of a block, or of the nearest one.
static inline float block_bound(const DensityGrid* grid, int x, int y, int z) {
    uint bx = grid->record.bx;
    uint by = grid->record.by;
    uint row = nearest_block(z, grid->record.bz) * by + nearest_block(y, by);
    return grid->bounds[row * bx + nearest_block(x, bx)];
}

#endif
