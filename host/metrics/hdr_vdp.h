// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_HDR_VDP_H
#define WEFT_METRICS_HDR_VDP_H

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Viewing conditions of the two images. The result depends on the absolute luminance.
struct HdrVdpSettings {
    double pixels_per_degree = 30.0;  ///< of visual angle, 0.01 ... 100000
    double viewing_distance = 0.5;    ///< metres, 0.001 ... 1000
    double luminance_scale = 100.0;   ///< cd/m^2 of the value 1, 1e-12 ... 1e12
    double peak_contrast = 0.006;     ///< contrast just seen at best, 1e-6 ... 1
    bool legacy_fan = false;          ///< orientation filters exactly as in HDR-VDP 1.7
    bool legacy_otf_grid = false;     ///< frequencies of the optics exactly as in HDR-VDP 1.7
};

/// Where and how often an observer sees that the two images differ.
struct HdrVdpResult {
    std::vector<float> probability;  ///< of detection, 0 ... 1, row-major
    double p75 = 0.0;                ///< percent of the pixels with a probability of at least 0.75
    double p95 = 0.0;                ///< percent of the pixels with a probability of at least 0.95
    double mean = 0.0;               ///< mean probability
};

/// The visible differences predictor for high dynamic range images of Mantiuk, Daly, Myszkowski and
/// Seidel 2005: the probability per pixel that `test` is seen to differ from `reference`. The order
/// matters: the eye adapts to the reference. Both maps hold width x height luminances, row-major,
/// top row first. A value that is NaN or not above 0 counts as the smallest positive one of both
/// maps, +Inf as the largest finite one; a map without any positive finite value is taken for
/// uniform darkness of 1e-4 cd/m^2, the least that the model tells apart. Blind to uniform changes
/// of brightness. Takes about 100 Fourier transforms of the image and 100 bytes per pixel. Throws
/// Error (bad_input) where the sizes do not fit, an edge is below 2 or a limit is exceeded, and
/// Error (usage) where a setting is out of its range.
[[nodiscard]] HdrVdpResult hdr_vdp(std::span<const float> test, std::span<const float> reference,
                                   std::uint32_t width, std::uint32_t height,
                                   const HdrVdpSettings& settings);

}  // namespace weft

#endif
