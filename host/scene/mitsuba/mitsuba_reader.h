// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_READER_H
#define WEFT_SCENE_MITSUBA_MITSUBA_READER_H

#include <filesystem>

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace weft {

/// Reads a Mitsuba 3 scene (`.xml`): perspective sensors, diffuse surfaces with colours and
/// bitmaps, area, point, spot, directional and constant emitters, PLY files and simple shapes,
/// media. Everything else is named once in `diagnostics`. Throws Error with `file:line` (exit
/// code 2) for broken XML, wrong values, missing references and files, and cycles.
[[nodiscard]] Scene read_mitsuba(const std::filesystem::path& path, Diagnostics& diagnostics,
                                 MaterialDetail detail = MaterialDetail::full);

}  // namespace weft

#endif
