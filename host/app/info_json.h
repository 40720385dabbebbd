// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_INFO_JSON_H
#define WEFT_APP_INFO_JSON_H

#include <nlohmann/json_fwd.hpp>

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace weft {

/// What `weft info --json` prints of a scene that was loaded: counts, bounds, animations, cameras,
/// lights, media, what is approximated, and what rendering it needs. Warns in `diagnostics`, which
/// holds the warnings of the reader, as rendering would of the scene's cameras.
[[nodiscard]] nlohmann::json info_json(const Scene& scene, Diagnostics& diagnostics);

}  // namespace weft

#endif
