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

/// The record of a grid whose voxels are the next in the list, without a place and without bounds.
shared::DensityGridRecord record_of(const DensityGrid& grid, const FlatGrids& flat) {
    shared::DensityGridRecord record{};
    record.nx = grid.size[0];
    record.ny = grid.size[1];
    record.nz = grid.size[2];
    record.first = static_cast<std::uint32_t>(flat.densities.size());
    record.block = 1;
    record.greatest = 1.0F;
    record.channels = grid.channels;
    return record;
}

/// A grid's record without a place.
shared::DensityGridRecord append(const DensityGrid& grid, FlatGrids& flat) {
    const DensityGrid greatest_of_voxels = greatest_channels(grid);
    const MajorantGrid majorants = make_majorant_grid(greatest_of_voxels);
    shared::DensityGridRecord record = record_of(grid, flat);
    record.bx = majorants.size[0];
    record.by = majorants.size[1];
    record.bz = majorants.size[2];
    record.first_bound = static_cast<std::uint32_t>(flat.bounds.size());
    record.block = majorants.block;
    const float greatest = greatest_density(grid);
    append_shares(greatest_of_voxels.densities, greatest, flat.densities);
    if (grid.channels == 3) append_shares(grid.densities, greatest, flat.densities);
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

void place(const glm::dmat4& to_world, const KernelUnits& units,
           shared::DensityGridRecord& record) {
    const glm::dmat4 to_cube = glm::inverse(to_world);
    record.to_x = row_of(to_cube, units, 0);
    record.to_y = row_of(to_cube, units, 1);
    record.to_z = row_of(to_cube, units, 2);
}

}  // namespace

std::uint32_t FlatGrids::add(const Scene& scene, const Medium& medium, const KernelUnits& units) {
    auto known = added_.find(medium.grid);
    if (known == added_.end()) {
        const DensityGrid& grid = scene.grids[static_cast<std::size_t>(medium.grid)];
        known = added_.emplace(medium.grid, append(grid, *this)).first;
    }
    shared::DensityGridRecord record = known->second;
    place(medium.grid_to_world, units, record);
    records.push_back(record);
    return static_cast<std::uint32_t>(records.size()) - 1;
}

std::uint32_t FlatGrids::add_albedo(const Scene& scene, const Medium& medium,
                                    const KernelUnits& units) {
    auto known = albedos_.find(medium.albedo_grid);
    if (known == albedos_.end()) {
        const DensityGrid& grid = scene.grids[static_cast<std::size_t>(medium.albedo_grid)];
        shared::DensityGridRecord made = record_of(grid, *this);
        made.bx = made.by = made.bz = 1;
        made.first_bound = static_cast<std::uint32_t>(bounds.size());
        bounds.push_back(1.0F);
        known = albedos_.emplace(medium.albedo_grid, made).first;
        densities.insert(densities.end(), grid.densities.begin(), grid.densities.end());
    }
    shared::DensityGridRecord record = known->second;
    place(medium.albedo_to_world, units, record);
    records.push_back(record);
    return static_cast<std::uint32_t>(records.size()) - 1;
}

}  // namespace weft
