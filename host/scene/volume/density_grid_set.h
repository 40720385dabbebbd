// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_VOLUME_DENSITY_GRID_SET_H
#define WEFT_SCENE_VOLUME_DENSITY_GRID_SET_H

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "scene/density_grid.h"

namespace weft {

/// The density grids that a scene file refers to, each read once, within limits::max_scene_voxels
/// for all of them.
class DensityGridSet {
  public:
    DensityGridSet(std::vector<DensityGrid>& grids, Diagnostics& diagnostics)
        : grids_(grids), diagnostics_(diagnostics) {}

    /// The index of a grid of a file, which is named where the file holds several (see
    /// read_density_grid). Throws Error (exit code 2) that names `place` or the file.
    [[nodiscard]] int add(const std::filesystem::path& path, const std::string& name,
                          const std::string& place);

  private:
    std::vector<DensityGrid>& grids_;
    Diagnostics& diagnostics_;
    std::map<std::pair<std::string, std::string>, int> indices_;
    std::size_t voxels_ = 0;
};

}  // namespace weft

#endif
