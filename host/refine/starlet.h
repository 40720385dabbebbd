// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_REFINE_STARLET_H
#define WEFT_REFINE_STARLET_H

#include <cstdint>
#include <vector>

namespace weft {

/// Values of the pixels of an image, row-major.
struct Plane {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> values;

    [[nodiscard]] float at(std::uint32_t x, std::uint32_t y) const {
        return values[std::size_t{y} * width + x];
    }
};

/// The plane, smoothed with the B3 spline (1, 4, 6, 4, 1)/16 along rows and columns, whose taps lie
/// `step` pixels apart; beyond an edge the image is mirrored in its last pixel. Runs on all cores,
/// with the same result on any number of them.
[[nodiscard]] Plane smoothed(const Plane& plane, std::uint32_t step);

/// How many scales of detail an image of this size is split into: the largest details are about
/// half as wide as its shorter side; at most 8.
[[nodiscard]] std::uint32_t starlet_scales(std::uint32_t width, std::uint32_t height);

/// Splits off the finest detail that is left in `coarse`, and leaves what is coarser: the starlet
/// transform (Starck, Fadili and Murtagh 2007, "The Undecimated Wavelet Decomposition and its
/// Reconstruction"), whose details and last coarse plane add up to the image. `scale` counts from
/// 0 on.
[[nodiscard]] Plane take_detail(Plane& coarse, std::uint32_t scale);

}  // namespace weft

#endif
