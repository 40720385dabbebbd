// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_PLY_PLY_SCENE_H
#define WEFT_SCENE_PLY_PLY_SCENE_H

#include <filesystem>

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace weft {

/// Reads a PLY file as a scene of one mesh, which is grey (0.8) or has the colours of its vertices.
/// Throws Error (exit code 2) as `read_ply` does.
[[nodiscard]] Scene read_ply_scene(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace weft

#endif
