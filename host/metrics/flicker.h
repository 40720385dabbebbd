// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_FLICKER_H
#define WEFT_METRICS_FLICKER_H

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "image/image.h"
#include "scene/scene.h"

namespace weft {

/// A picture of a sequence: beauty with the layers emission, albedo, normal and depth as renderers
/// write them, and where it was seen from.
struct SequencePicture {
    const Image& image;
    const Camera& camera;
};

/// Stands for no pixel.
inline constexpr std::uint32_t no_pixel = std::numeric_limits<std::uint32_t>::max();

/// For every pixel of `now` the one of `before` within which its surface point lay, or no_pixel
/// where that shows another surface: where the normals differ by more than acos(0.9), the other
/// point lies more than two pixel footprints off this one's tangent plane, or an albedo differs by
/// more than 1 %. Background and light sources have none.
[[nodiscard]] std::vector<std::uint32_t> matching_pixels(const SequencePicture& before,
                                                         const SequencePicture& now);

/// How much more a sequence changes than its reference does: for every pixel that `matches` finds
/// again |P(now) - P(before)| of the test less the same of the reference, P being the PU21 units
/// of the luminance (see pu21_encode; a unit is about a just noticeable difference) with
/// `luminance_scale` cd/m^2 of radiance 1. 0 where there is no match. Throws std::invalid_argument
/// unless all pictures have one size.
[[nodiscard]] std::vector<float> excess_change(const Image& before, const Image& now,
                                               const Image& reference_before,
                                               const Image& reference_now,
                                               std::span<const std::uint32_t> matches,
                                               double luminance_scale);

}  // namespace weft

#endif
