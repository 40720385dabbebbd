// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_DENOISE_VIEW_H
#define WEFT_DENOISE_DENOISE_VIEW_H

#include <cstdint>

#include "scene/scene.h"

namespace weft {

/// How the camera of an image sees, as far as denoisers have to know.
struct DenoiseView {
    bool orthographic = false;
    /// Width of a pixel: at the distance 1 of a pinhole camera, else at any; scene units.
    double pixel = 1.0;
    /// Participating media may add light to any pixel, so that albedo does not explain its colour.
    bool media = false;
};

/// What a camera sees in an image of that size, in pixels.
[[nodiscard]] DenoiseView denoise_view(const Camera& camera, std::uint32_t width,
                                       std::uint32_t height, bool media);

}  // namespace weft

#endif
