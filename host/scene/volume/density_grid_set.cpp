// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/density_grid_set.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/limits.h"
#include "scene/volume/density_grid_file.h"

namespace weft {

int DensityGridSet::add(const std::filesystem::path& path, const std::string& name,
                        const std::string& place) {
    const std::pair key(path.lexically_normal().string(), name);
    if (const auto found = indices_.find(key); found != indices_.end()) return found->second;
    DensityGrid grid = read_density_grid(path, name, place, diagnostics_);
    if (grid.densities.size() > limits::max_scene_voxels - voxels_)
        throw input_error(place, fmt::format("the density grids of the scene together have more "
                                             "than {} voxels, expected at most as many",
                                             limits::max_scene_voxels));
    voxels_ += grid.densities.size();
    grids_.push_back(std::move(grid));
    const int index = static_cast<int>(grids_.size()) - 1;
    indices_.emplace(key, index);
    return index;
}

}  // namespace weft
