// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_READER_H
#define WEFT_SCENE_GLTF_GLTF_READER_H

#include <filesystem>

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace weft {

/// Reads glTF 2.0, `.gltf` or `.glb`. Only what the rendered scene refers to is read, of materials
/// as much as `detail` says. Values in
/// photometric units are taken as radiometric ones without conversion. Throws Error (exit code 2)
/// with `file#/json/pointer` for anything broken.
[[nodiscard]] Scene read_gltf(const std::filesystem::path& path, Diagnostics& diagnostics,
                              MaterialDetail detail = MaterialDetail::full);

}  // namespace weft

#endif
