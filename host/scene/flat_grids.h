// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_FLAT_GRIDS_H
#define WEFT_SCENE_FLAT_GRIDS_H

#include <cstdint>
#include <map>
#include <vector>

#include "scene/scene.h"
#include "shared/shared_types.h"

namespace weft {

struct KernelUnits;

/// Density grids as kernels read them (kernels/media/density_grid.h). Densities are shares of the
/// greatest one of their grid, so that however large they are no product with them overflows.
struct FlatGrids {
    std::vector<shared::DensityGridRecord> records;  ///< of densities and albedos of media
    std::vector<float> densities;                    ///< of all grids, each once
    std::vector<float> bounds;

    /// Adds the grid of a medium, which must have voxels; returns the number of its record.
    std::uint32_t add(const Scene& scene, const Medium& medium, const KernelUnits& units);

    /// The same for its grid of albedos.
    std::uint32_t add_albedo(const Scene& scene, const Medium& medium, const KernelUnits& units);

  private:
    std::map<int, shared::DensityGridRecord> added_;    ///< by index into Scene::grids
    std::map<int, shared::DensityGridRecord> albedos_;  ///< likewise
};

}  // namespace weft

#endif
