// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_INFO_SURFACES_H
#define WEFT_APP_INFO_SURFACES_H

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scene/scene.h"

namespace weft {

/// The materials that the file describes as more than Lambertian: their lobes with the class of
/// their roughness, and the effects that these call for.
[[nodiscard]] nlohmann::json surfaces_json(const Scene& scene);

/// One entry of surfaces_json for a terminal: `metal (glossy), diffuse: glossy reflection`.
[[nodiscard]] std::string describe_surface(const nlohmann::json& surface);

}  // namespace weft

#endif
