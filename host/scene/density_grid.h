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

/// Densities of a medium in the unit cube, a multiplier of its extinction, or its albedos. Voxel
/// (i, j, k) is the value at ((i + 1/2) / nx, (j + 1/2) / ny, (k + 1/2) / nz); between voxels
/// densities are trilinear, within half a voxel of a face as on the outermost voxels' centres, and
/// outside the cube 0. A grid without voxels means that there is no medium.
struct DensityGrid {
    GridSize size{};
    /// Of voxel (i, j, k) at (k ny + j) nx + i, first all of the first channel; finite, at least 0.
    std::vector<float> densities;
    glm::dmat4 placement{1.0};   ///< from the unit cube to the space that the file defines
    std::uint32_t channels = 1;  ///< 3: red, green and blue
};

/// The number of voxels of a grid of these sizes, 0 where a size is 0. Throws Error (exit code 2)
/// that names `place` where there are more than limits::max_grid_voxels.
[[nodiscard]] std::size_t checked_voxel_count(const GridSize& size, const std::string& place);

/// Throws Error (exit code 2) unless there are as many densities as voxels times one or three
/// channels, no more than are allowed, and all of them are finite and at least 0; it names `place`
/// and the voxel.
void validate_density_grid(const DensityGrid& grid, const std::string& place);

/// The greatest density of all voxels and channels, and so of all points; 0 where there is no
/// medium.
[[nodiscard]] float greatest_density(const DensityGrid& grid);

/// The mean over all voxels of each channel, of which there are three, or one that stands for all;
/// 0 without voxels.
[[nodiscard]] glm::dvec3 mean_density(const DensityGrid& grid);

/// The greatest channel of each voxel, as a grid of one channel.
[[nodiscard]] DensityGrid greatest_channels(const DensityGrid& grid);

}  // namespace weft

#endif
