// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_FLIP_H
#define WEFT_METRICS_FLIP_H

#include <vector>

#include "metrics/rgb_view.h"

namespace weft {

/// Pixels per degree of a 3840 pixel wide, 0.7 m wide monitor seen from 0.7 m.
inline constexpr double flip_default_ppd = 3840.0 * 3.14159265358979323846 / 180.0;

/// The difference that a person sees when flipping between two images.
struct FlipResult {
    std::vector<float> map;  ///< per pixel, 0 (none) to 1
    double mean = 0.0;
};

/// LDR-FLIP (Andersson et al. 2020) of two display images, linear values; those outside of [0, 1]
/// are clamped. Throws std::invalid_argument unless sizes agree and 1 <= ppd <= 1000.
[[nodiscard]] FlipResult ldr_flip(const RgbView& reference, const RgbView& test,
                                  double pixels_per_degree = flip_default_ppd);

/// The exposures at which HDR-FLIP compares images, in stops.
struct FlipExposures {
    double start = 0.0;
    double stop = 0.0;
    int count = 1;
};

/// The exposures from the one that keeps the brightest pixel of the reference below white to the
/// one that brings its median luminance there. A black reference has one exposure, 0; where half or
/// more is black, the median is that of the other pixels.
[[nodiscard]] FlipExposures flip_exposures(const RgbView& reference);

/// HDR-FLIP (Andersson et al. 2021): the largest LDR-FLIP of each pixel over these exposures, after
/// the ACES tone curve. Negative values count as 0.
[[nodiscard]] FlipResult hdr_flip(const RgbView& reference, const RgbView& test,
                                  const FlipExposures& exposures,
                                  double pixels_per_degree = flip_default_ppd);

}  // namespace weft

#endif
