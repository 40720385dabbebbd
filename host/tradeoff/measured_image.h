// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_MEASURED_IMAGE_H
#define WEFT_TRADEOFF_MEASURED_IMAGE_H

#include <cstdint>
#include <functional>
#include <span>

#include "denoise/image_denoiser.h"
#include "device/executor.h"
#include "image/image.h"
#include "plan/preset.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft {

/// An image, and its time, samples and rays.
struct MeasuredImage {
    Image image;               ///< its beauty layer alone
    double ms = 0.0;           ///< wall time of its frames, and of removing noise
    double denoise_ms = 0.0;   ///< the part of ms that removing noise took, whatever the samples
    std::uint32_t frames = 0;  ///< samples of every pixel
    std::uint64_t rays = 0;
};

/// The inputs that all images of one measurement share.
struct ImageSubject {
    Executor& executor;  ///< one that shares its acceleration structure, such as SharedScene
    const FlatScene& scene;
    const Camera& camera;
    FilmSize size;
    /// Called now and then; where it returns false, an image ends incomplete. Empty: go on always.
    std::function<bool()> keep_going{};
    /// What presets may ask for, one of a kind; those of others are not applied.
    std::span<const ImageDenoiser> denoisers{};
};

/// Makes an image with a renderer of its own. The time is that of the frames, as in `weft
/// render`, and of removing noise where the preset asks for that; without reading, building the
/// acceleration structure and the kernels, or allocating buffers. `first_alone`: stops after the
/// first frame.
[[nodiscard]] MeasuredImage measure_image(const ImageSubject& subject, const Preset& preset,
                                          std::uint32_t seed, bool first_alone = false);

}  // namespace weft

#endif
