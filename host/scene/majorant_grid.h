// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MAJORANT_GRID_H
#define WEFT_SCENE_MAJORANT_GRID_H

#include <cstdint>
#include <vector>

#include "scene/density_grid.h"

namespace weft {

/// Upper bounds of a density grid. Block (i, j, k) covers the voxels [b i, b i + b) along x, and so
/// on along y and z, whole: to their outer faces, half a voxel beyond their centres. The last block
/// of an axis may reach beyond the grid.
struct MajorantGrid {
    std::uint32_t block = 1;    ///< edge length of a block in voxels
    GridSize size{};            ///< in blocks
    std::vector<float> bounds;  ///< of block (i, j, k) at (k size[1] + j) size[0] + i
};

/// The edge length in voxels of the blocks of a grid: the smallest power of two from 4 on with
/// which no axis has more than 64 blocks. Small blocks bound the density tightly, few blocks are
/// crossed quickly.
[[nodiscard]] std::uint32_t majorant_block(const GridSize& size);

/// The bounds of a valid grid: for every block the greatest density of its voxels and their
/// neighbours.
/// Trilinear interpolation up to half a voxel outside a block stays below its bound, so that the
/// rounding of a position does not matter.
[[nodiscard]] MajorantGrid make_majorant_grid(const DensityGrid& grid);

}  // namespace weft

#endif
