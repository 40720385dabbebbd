// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_PLY_PLY_READER_H
#define WEFT_SCENE_PLY_PLY_READER_H

#include <filesystem>
#include <string>

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace weft {

/// Reads a PLY file (ascii, binary little or big endian): vertices with x y z, and where present
/// nx ny nz, u v (also s t, texture_u texture_v) and red green blue (integers are sRGB, floats
/// linear); faces as lists `vertex_indices` or `vertex_index`, polygons cut into fans. All else is
/// skipped. Triangles that use a non-finite vertex and faces of fewer than three corners are
/// dropped with a warning. `place` is where the file is referred to, for a file that cannot be
/// read; other errors name `file.ply:line`, or `file.ply: face 17` in binary data (exit code 2).
[[nodiscard]] Mesh read_ply(const std::filesystem::path& path, const std::string& place,
                            Diagnostics& diagnostics);

}  // namespace weft

#endif
