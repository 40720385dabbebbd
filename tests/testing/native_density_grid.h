// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Density grids for tests that include the kernels' headers in namespace `native` beforehand.
#ifndef WEFT_TESTS_TESTING_NATIVE_DENSITY_GRID_H
#define WEFT_TESTS_TESTING_NATIVE_DENSITY_GRID_H

#include "scene/density_grid.h"
#include "scene/majorant_grid.h"

namespace weft {

/// A grid as the kernels see it, at some place of longer buffers. It is not copied: `view` points
/// into it.
class NativeGrid {
  public:
    explicit NativeGrid(const DensityGrid& grid)
        : majorants_(make_majorant_grid(grid)), densities_(3, -1.0F), bounds_(5, -1.0F) {
        densities_.insert(densities_.end(), grid.densities.begin(), grid.densities.end());
        bounds_.insert(bounds_.end(), majorants_.bounds.begin(), majorants_.bounds.end());
        const GridSize& blocks = majorants_.size;
        record_ = {grid.size[0],
                   grid.size[1],
                   grid.size[2],
                   3U,
                   blocks[0],
                   blocks[1],
                   blocks[2],
                   5U,
                   majorants_.block,
                   greatest_density(grid),
                   0U,
                   0U,
                   {1.0F, 0.0F, 0.0F, 0.0F},
                   {0.0F, 1.0F, 0.0F, 0.0F},
                   {0.0F, 0.0F, 1.0F, 0.0F}};
    }
    NativeGrid(const NativeGrid&) = delete;
    NativeGrid& operator=(const NativeGrid&) = delete;

    [[nodiscard]] native::DensityGrid view() const {
        return native::density_grid(record_, densities_.data(), bounds_.data());
    }
    [[nodiscard]] const native::DensityGridRecord& record() const { return record_; }
    [[nodiscard]] const std::vector<float>& densities() const { return densities_; }
    [[nodiscard]] const std::vector<float>& bounds() const { return bounds_; }

  private:
    MajorantGrid majorants_;
    std::vector<float> densities_, bounds_;
    native::DensityGridRecord record_{};
};

}  // namespace weft

#endif
