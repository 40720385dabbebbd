// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_DENSITY_H
#define WEFT_SCENE_GLTF_GLTF_DENSITY_H

#include <filesystem>
#include <vector>

#include "base/diagnostics.h"
#include "base/json_value.h"
#include "scene/scene.h"
#include "scene/volume/density_grid_set.h"

namespace weft {

/// The density grids of a document's media.
class GltfDensities {
  public:
    GltfDensities(const std::filesystem::path& document, std::vector<DensityGrid>& grids,
                  Diagnostics& diagnostics)
        : document_(document), grids_(grids), set_(grids, diagnostics) {}

    /// Gives the medium the grid of a `density` object of WEFT_medium: `uri`, `grid`, `box` and
    /// `matrix`. Throws Error (exit code 2) for a file that is missing or broken, a box without a
    /// volume and a matrix that is not affine or cannot be inverted.
    void read(const JsonValue& density, Medium& medium);

  private:
    const std::filesystem::path& document_;
    std::vector<DensityGrid>& grids_;
    DensityGridSet set_;
};

}  // namespace weft

#endif
