// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/density_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>

#include "base/error.h"
#include "base/limits.h"

namespace weft {

std::size_t checked_voxel_count(const GridSize& size, const std::string& place) {
    if (std::find(size.begin(), size.end(), 0U) != size.end()) return 0;
    // Not a product that is checked afterwards: three 32-bit numbers overflow 64 bits.
    std::size_t count = 1;
    for (const std::uint32_t edge : size) {
        if (edge > limits::max_grid_voxels / count)
            throw input_error(place,
                              fmt::format("a grid of {} x {} x {} voxels, expected at "
                                          "most {} voxels",
                                          size[0], size[1], size[2], limits::max_grid_voxels));
        count *= edge;
    }
    return count;
}

void validate_density_grid(const DensityGrid& grid, const std::string& place) {
    const GridSize& size = grid.size;
    const std::size_t count = checked_voxel_count(size, place);
    if (grid.channels != 1 && grid.channels != 3)
        throw input_error(place,
                          fmt::format("a grid of {} channels, expected 1 or 3", grid.channels));
    if (grid.densities.size() != count * grid.channels)
        throw input_error(place, fmt::format("{} densities for a grid of {} x {} x {} voxels",
                                             grid.densities.size(), size[0], size[1], size[2]));
    // False for NaN as well.
    const auto is_density = [](float value) {
        return value >= 0.0F && value <= std::numeric_limits<float>::max();
    };
    const auto bad = std::find_if_not(grid.densities.begin(), grid.densities.end(), is_density);
    if (bad == grid.densities.end()) return;
    const auto index = static_cast<std::size_t>(bad - grid.densities.begin()) % count;
    throw input_error(place, fmt::format("voxel ({}, {}, {}) is {}, expected a finite density of "
                                         "at least 0",
                                         index % size[0], index / size[0] % size[1],
                                         index / size[0] / size[1], *bad));
}

float greatest_density(const DensityGrid& grid) {
    const auto greatest = std::max_element(grid.densities.begin(), grid.densities.end());
    return greatest == grid.densities.end() ? 0.0F : *greatest;
}

glm::dvec3 mean_density(const DensityGrid& grid) {
    glm::dvec3 mean(0.0);
    if (grid.densities.empty()) return mean;
    const std::size_t count = grid.densities.size() / grid.channels;
    for (std::uint32_t c = 0; c < 3; ++c) {
        const std::size_t plane = grid.channels == 3 ? c * count : 0;
        double sum = 0.0;
        for (std::size_t i = 0; i < count; ++i)
            sum += static_cast<double>(grid.densities[plane + i]);
        mean[static_cast<int>(c)] = sum / static_cast<double>(count);
    }
    return mean;
}

DensityGrid greatest_channels(const DensityGrid& grid) {
    if (grid.channels == 1) return grid;
    DensityGrid greatest;
    greatest.size = grid.size;
    greatest.placement = grid.placement;
    const std::size_t count = grid.densities.size() / grid.channels;
    greatest.densities.assign(grid.densities.begin(),
                              grid.densities.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = count; i < grid.densities.size(); ++i)
        greatest.densities[i % count] = std::max(greatest.densities[i % count], grid.densities[i]);
    return greatest;
}

}  // namespace weft
