// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_VOLUME_DENSITY_GRID_FILE_H
#define WEFT_SCENE_VOLUME_DENSITY_GRID_FILE_H

#include <filesystem>
#include <string>

#include "base/diagnostics.h"
#include "scene/density_grid.h"

namespace weft {

/// Reads a Mitsuba grid volume or a NanoVDB file, told apart by their first bytes. `name` chooses a
/// grid of a NanoVDB file (see unpack_nanovdb). `place` is where the file is referred to, for one
/// that cannot be read; other errors name the file itself (exit code 2).
[[nodiscard]] DensityGrid read_density_grid(const std::filesystem::path& path,
                                            const std::string& name, const std::string& place,
                                            Diagnostics& diagnostics);

}  // namespace weft

#endif
