// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_VOLUME_VOL_READER_H
#define WEFT_SCENE_VOLUME_VOL_READER_H

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "base/diagnostics.h"
#include "scene/density_grid.h"

namespace weft {

/// Whether the bytes of a file begin as those of a Mitsuba grid volume do.
[[nodiscard]] bool is_vol(std::span<const std::byte> bytes);

/// Reads a Mitsuba grid volume (`.vol`, version 3, float32, one or three
/// channels) into a valid grid, which
/// its bounding box places. An invalid bounding box counts as the unit cube, with a warning, since
/// it seldom matters. Bytes behind the voxels are ignored with a warning. `file` names the file in
/// errors (exit code 2).
[[nodiscard]] DensityGrid decode_vol(std::span<const std::byte> bytes, const std::string& file,
                                     Diagnostics& diagnostics);

}  // namespace weft

#endif
