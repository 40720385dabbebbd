// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/flat_grids.h"

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <iterator>
#include <utility>

#include "scene/flat_scene.h"
#include "scene/majorant_grid.h"

namespace weft {
namespace {

void append_shares(const std::vector<float>& values, float whole, std::vector<float>& shares) {
    shares.reserve(shares.size() + values.size());
    std::transform(values.begin(), values.end(), std::back_inserter(shares),
                   [&](float value) { return value / whole; });
}

/// A grid's record without a place.
shared::DensityGridRecord append(const DensityGrid& grid, FlatGrids& flat) {
    const MajorantGrid majorants = make_majorant_grid(grid);
    shared::DensityGridRecord record{};
    record.nx = grid.size[0];
    record.ny = grid.size[1];
    record.nz = grid.size[2];
    record.first = static_cast<std::uint32_t>(flat.densities.size());
    record.bx = majorants.size[0];
    record.by = majorants.size[1];
    record.bz = majorants.size[2];
    record.first_bound = static_cast<std::uint32_t>(flat.bounds.size());
    record.block = majorants.block;
    record.greatest = 1.0F;
    const float greatest = greatest_density(grid);
    append_shares(grid.densities, greatest, flat.densities);
    append_shares(majorants.bounds, greatest, flat.bounds);
    return record;
}

/// A row of the map from kernel space to the unit cube.
shared::float4 row_of(const glm::dmat4& to_cube, const KernelUnits& units, int row) {
    const glm::dvec3 linear(to_cube[0][row], to_cube[1][row], to_cube[2][row]);
    const double moved = glm::dot(linear, units.centre) + to_cube[3][row];
    const glm::vec3 scaled(linear / units.scale);
    return {scaled.x, scaled.y, scaled.z, static_cast<float>(moved)};
}

}  // namespace

std::uint32_t FlatGrids::add(const Scene& scene, const Medium& medium, const KernelUnits& units) {
    auto known = added_.find(medium.grid);
    if (known == added_.end()) {
        const DensityGrid& grid = scene.grids[static_cast<std::size_t>(medium.grid)];
        known = added_.emplace(medium.grid, append(grid, *this)).first;
    }
    shared::DensityGridRecord record = known->second;
    const glm::dmat4 to_cube = glm::inverse(medium.grid_to_world);
    record.to_x = row_of(to_cube, units, 0);
    record.to_y = row_of(to_cube, units, 1);
    record.to_z = row_of(to_cube, units, 2);
    records.push_back(record);
    return static_cast<std::uint32_t>(records.size()) - 1;
}

}  // namespace weft
