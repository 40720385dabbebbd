// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_NOISY_LIGHT_H
#define WEFT_DENOISE_NOISY_LIGHT_H

#include <array>

#include "denoise/denoise_view.h"
#include "denoise/padding.h"
#include "image/image.h"

namespace weft {

/// What the statistical denoiser averages: the light that pixels reflect, over their albedo, and
/// its variance. Where media add light it is not divided, as if each albedo were 1.
struct NoisyLight {
    /// Reads the layers beauty, emission, albedo and variance. Throws std::invalid_argument where
    /// one is missing.
    NoisyLight(const Image& image, const DenoiseView& view, const Padding& padding);

    /// 1 where the light of a pixel takes part, else 0: not where something shines, whose noise is
    /// not told apart from that of the light it reflects, nor where nothing is reflected.
    PaddedPlane lit;
    std::array<PaddedPlane, 3> mean;
    /// Of the mean; below 0 in channels of no albedo, whose light is unknown.
    std::array<PaddedPlane, 3> variance;
    double scale = 1.0;  ///< a power of two that mean was multiplied by, to be about 1 at most
};

}  // namespace weft

#endif
