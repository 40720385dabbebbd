// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_CAMERA_OPTIONS_H
#define WEFT_APP_CAMERA_OPTIONS_H

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "render/camera_placement.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds --camera, and what places the camera elsewhere.
void add_camera(CLI::App& command);

/// Reads what places the camera. Throws Error (exit code 1).
[[nodiscard]] CameraPlacement read_placement(const CLI::App& command);

/// The options that read_placement reads as this placement, to the last bit.
[[nodiscard]] std::vector<std::string> placement_arguments(const CameraPlacement& placement);

/// Sets look_from, look_at, up and fov, in degrees, of `json`; null for what is empty.
void add_placement_json(const CameraPlacement& placement, nlohmann::json& json);

}  // namespace weft

#endif
