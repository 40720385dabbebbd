// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_VOLUME_NANOVDB_READER_H
#define WEFT_SCENE_VOLUME_NANOVDB_READER_H

#include <cstddef>
#include <span>
#include <string>

#include "base/diagnostics.h"
#include "scene/density_grid.h"

namespace weft {

/// Reads a grid of a NanoVDB file (see unpack_nanovdb for which one) into a valid, dense grid: all
/// voxels of the bounding box of its active ones, and one of the background about them, so that
/// densities fall to the background within a voxel. Grids of floats, doubles and quantised floats
/// (Fp4, Fp8, Fp16, FpN) are read. Its placement is the grid's map, from the voxels' indices to the
/// file's world. A background above 0 is not continued outside, with a warning. `file` names the
/// file in errors (exit code 2).
[[nodiscard]] DensityGrid decode_nanovdb(std::span<const std::byte> bytes, const std::string& name,
                                         const std::string& file, Diagnostics& diagnostics);

}  // namespace weft

#endif
