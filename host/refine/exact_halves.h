// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_REFINE_EXACT_HALVES_H
#define WEFT_REFINE_EXACT_HALVES_H

#include <array>
#include <cstdint>
#include <limits>

#include "refine/starlet.h"

namespace weft {

/// The red, green and blue plane of some light of an image.
using ColourPlanes = std::array<Plane, 3>;

/// What unbiased samples say of the same light, or of its difference to a preview, in two
/// independent halves.
struct ExactHalves {
    ColourPlanes first, second;
    float first_share = 0.5F;  ///< of the samples that the first half has, in (0, 1)
    /// Of each pixel in both halves, from 2 on.
    std::uint64_t samples = std::numeric_limits<std::uint64_t>::max();

    /// The mean of all samples.
    [[nodiscard]] float mean(std::size_t channel, std::size_t pixel) const {
        return first_share * first[channel].values[pixel] +
               (1.0F - first_share) * second[channel].values[pixel];
    }
};

/// What the halves say of the power of one pixel, summed over the channels.
struct HalfProducts {
    float signal = 0.0F;  ///< product of both: on average the power without noise
    float power = 0.0F;   ///< square of the mean of all samples
};

/// Finds them for a pixel.
[[nodiscard]] inline HalfProducts half_products(const ExactHalves& halves, std::size_t pixel) {
    HalfProducts sum;
    for (std::size_t c = 0; c < 3; ++c) {
        const float mean = halves.mean(c, pixel);
        sum.signal += halves.first[c].values[pixel] * halves.second[c].values[pixel];
        sum.power += mean * mean;
    }
    return sum;
}

}  // namespace weft

#endif
