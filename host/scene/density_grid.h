// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_DENSITY_GRID_H
#define WEFT_SCENE_DENSITY_GRID_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace weft {

/// Edge lengths of a grid along x, y and z, in voxels or blocks.
using GridSize = std::array<std::uint32_t, 3>;

/// Densities of a medium in the unit cube, a multiplier of its extinction. Voxel (i, j, k) is the
/// value at ((i + 1/2) / nx, (j + 1/2) / ny, (k + 1/2) / nz); between voxels densities are
/// trilinear, within half a voxel of a face as on the outermost voxels' centres, and outside the
/// cube 0. A grid without voxels means that there is no medium.
struct DensityGrid {
    GridSize size{};
    std::vector<float> densities;  ///< of voxel (i, j, k) at (k ny + j) nx + i; finite, at least 0
    glm::dmat4 placement{1.0};     ///< from the unit cube to the space that the file defines
};

/// The number of voxels of a grid of these sizes, 0 where a size is 0. Throws Error (exit code 2)
/// that names `place` where there are more than limits::max_grid_voxels.
[[nodiscard]] std::size_t checked_voxel_count(const GridSize& size, const std::string& place);

/// Throws Error (exit code 2) unless there are as many densities as voxels, no more than are
/// allowed, and all of them are finite and at least 0; it names `place` and the voxel.
void validate_density_grid(const DensityGrid& grid, const std::string& place);

/// The greatest density of all voxels, and so of all points; 0 where there is no medium.
[[nodiscard]] float greatest_density(const DensityGrid& grid);

}  // namespace weft

#endif
