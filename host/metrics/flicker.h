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

/// An image of a sequence: beauty with the layers emission, albedo, normal and depth as renderers
/// write them, and its camera.
struct SequenceImage {
    const Image& image;
    const Camera& camera;
};

/// Index of no pixel.
inline constexpr std::uint32_t no_pixel = std::numeric_limits<std::uint32_t>::max();

/// For every pixel of `now` the pixel of `before` in which its surface point lay, or no_pixel where
/// that pixel shows another surface: where the normals differ by more than acos(0.9), the other
/// point lies more than two pixel footprints off this one's tangent plane, or an albedo differs by
/// more than 1 %. Pixels of the background and of light sources have none.
[[nodiscard]] std::vector<std::uint32_t> matching_pixels(const SequenceImage& before,
                                                         const SequenceImage& now);

/// Flicker: how much more a sequence changes than its reference does. For every pixel with a match
/// in `matches`, |P(now) - P(before)| of the test minus that of the reference, where P is the
/// luminance in PU21 units (see pu21_encode; a unit is about a just noticeable difference) with
/// `luminance_scale` cd/m^2 of radiance 1. 0 where there is no match. Throws std::invalid_argument
/// unless all images have one size.
[[nodiscard]] std::vector<float> excess_change(const Image& before, const Image& now,
                                               const Image& reference_before,
                                               const Image& reference_now,
                                               std::span<const std::uint32_t> matches,
                                               double luminance_scale);

}  // namespace weft

#endif
