// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_IMAGE_SETTINGS_H
#define WEFT_APP_IMAGE_SETTINGS_H

#include <cstdint>
#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "render/reference_renderer.h"
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

/// Those of the algorithms that is_reference() names, which share some with others (`common`).
[[nodiscard]] PathSettings path_settings(const RenderOptions& options,
                                         const RenderSettings& common);

/// Warns where no light shines in the scene.
void warn_about_darkness(const FlatScene& flat, const std::string& scene, Diagnostics& diagnostics);

/// Refuses options that do not support participating media in a scene with any. Throws Error (exit
/// code 1).
void check_media(const RenderOptions& options, const FlatScene& flat);

/// Refuses an orthographic camera whose rays begin in several media. Throws Error (exit code 2).
void check_orthographic(const RenderOptions& options, const RenderSettings& settings,
                        const FlatScene& flat, const Camera& camera);

}  // namespace weft

#endif
