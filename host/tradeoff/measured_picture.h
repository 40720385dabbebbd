// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_MEASURED_PICTURE_H
#define WEFT_TRADEOFF_MEASURED_PICTURE_H

#include <cstdint>
#include <functional>

#include "device/executor.h"
#include "image/image.h"
#include "plan/preset.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft {

/// A picture, and what it took.
struct MeasuredPicture {
    Image image;               ///< its beauty layer alone
    double ms = 0.0;           ///< wall time of its frames
    std::uint32_t frames = 0;  ///< samples of every pixel
    std::uint64_t rays = 0;
};

/// What all pictures of one measurement have in common.
struct PictureSubject {
    Executor& executor;  ///< whose acceleration structure is shared
    const FlatScene& scene;
    const Camera& camera;
    FilmSize size;
    /// Asked now and then; where it says no, a picture ends incomplete. Empty: always.
    std::function<bool()> go_on{};
};

/// Makes a picture with a renderer of its own. What is timed is what `weft render` takes for its
/// frames: not reading, building the acceleration structure and the kernels, or allocating buffers.
/// `first_alone`: stops after the first frame.
[[nodiscard]] MeasuredPicture measure_picture(const PictureSubject& subject, const Preset& preset,
                                              std::uint32_t seed, bool first_alone = false);

}  // namespace weft

#endif
