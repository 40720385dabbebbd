// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_IMAGE_SETTINGS_H
#define WEFT_APP_IMAGE_SETTINGS_H

#include <cstdint>
#include <optional>

#include "render/renderer.h"
#include "scene/scene.h"

namespace weft {

struct RenderOptions;

/// Samples per pixel: those given, or so many that a single image is clean; empty where something
/// else ends rendering.
[[nodiscard]] std::optional<std::uint32_t> samples_of(const RenderOptions& options,
                                                      const Scene& scene);

/// The settings of the image or images that the options ask for.
[[nodiscard]] RenderSettings image_settings(const RenderOptions& options, const Scene& scene);

}  // namespace weft

#endif
