// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_CAMERA_PARAMS_H
#define WEFT_RENDER_CAMERA_PARAMS_H

#include <cstdint>
#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"
#include "scene/scene_bounds.h"
#include "shared/shared_types.h"

namespace weft {

/// Parameters of the scene and the camera that every kernel gets, for an image of that size.
[[nodiscard]] shared::RenderParams scene_params(const FlatScene& scene, const Camera& camera,
                                                std::uint32_t width, std::uint32_t height);

/// Sets the fields of `params` that come from the scene alone.
void set_scene(const FlatScene& scene, shared::RenderParams& params);

/// Sets the camera fields of `params` for an image of params.camera.width x params.camera.height
/// square pixels.
void set_camera(const Camera& camera, const KernelUnits& units, shared::RenderParams& params);

/// Number of blocks of pixels that cover an image, each a packet of primary rays of `lanes`.
[[nodiscard]] std::uint32_t pixel_blocks(std::uint32_t width, std::uint32_t height,
                                         std::uint32_t lanes);

/// FEATURE_* of kernels that make rays of the camera.
[[nodiscard]] std::uint32_t camera_features(const Camera& camera);

/// Whether the same boundaries of media lie around the middle and the corners of the image's near
/// plane, so that kernels may take it for all rays.
[[nodiscard]] bool starts_in_one_medium(const FlatScene& scene, const Camera& camera,
                                        std::uint32_t width, std::uint32_t height);

/// Sets the sample position of frame `frame` inside the pixel, in [0, 1)^2: the centre where only
/// one frame is made (`single`), else points of a Halton sequence shifted by the seed, the same for
/// all pixels.
void set_jitter(std::uint32_t frame, bool single, std::uint32_t seed, shared::RenderParams& params);

/// The camera of that name; the first where `name` is empty. A scene without cameras gets one that
/// shows `bounds`, by default those of the scene as it stands, and a warning says so. Throws Error
/// (exit code 1) that lists the names.
[[nodiscard]] Camera choose_camera(const Scene& scene, const FlatScene& flat,
                                   const std::string& name, Diagnostics& diagnostics,
                                   const std::optional<SceneBounds>& bounds = {});

/// The camera as it stands at `time`, seconds; unchanged where it does not move. Throws Error (exit
/// code 2) where its transform is unusable then, such as one scaled to nothing.
[[nodiscard]] Camera camera_at(const Scene& scene, const Camera& camera, double time);

}  // namespace weft

#endif
