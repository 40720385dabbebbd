// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_NUMERIC_H
#define WEFT_METRICS_NUMERIC_H

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "metrics/rgb_view.h"

namespace weft {

// Metrics without a model of the eye, computed in double precision. A metric without a value is
// empty, such as a relative error where a value differs from a reference of 0.

/// Errors relative to the reference, over all pixels and channels.
struct RelativeErrors {
    std::optional<double> relmse;          ///< mean of (x - r)^2 / (r^2 + 0.01 mean(r)^2)
    std::optional<double> relmse_trimmed;  ///< the same without the worst 0.1 % of the pixels
    std::optional<double> mape;            ///< mean of |x - r| / (|r| + 0.01 |mean(r)|)
    std::optional<double> mean_ratio;      ///< mean(x) / mean(r)
    std::optional<double> bias;            ///< mean_ratio - 1
    std::vector<float> relmse_map;  ///< per pixel, the mean of its channels; +Inf where undefined
};

/// Computes all of these. Equal black pixels of a black image have no error. Throws
/// std::invalid_argument unless sizes agree; values have to be finite.
[[nodiscard]] RelativeErrors relative_errors(const RgbView& reference, const RgbView& test);

/// Peak signal-to-noise ratio in dB; +Inf for equal values. `peak` is above 0.
[[nodiscard]] double psnr(std::span<const float> reference, std::span<const float> test,
                          double peak);

/// Structural similarity (Wang et al. 2004) of two planes whose values range over `range`: the mean
/// over all 11x11 windows inside of the image, weighted by a Gaussian of sigma 1.5, K1 = 0.01 and
/// K2 = 0.03. 1 for equal planes; empty where an edge is shorter than a window.
[[nodiscard]] std::optional<double> ssim(std::span<const float> reference,
                                         std::span<const float> test, std::uint32_t width,
                                         std::uint32_t height, double range);

/// PU21 (Mantiuk and Azimi 2021, banding and glare): perceptually uniform units of a luminance in
/// cd/m^2, which is clamped to [0.005, 10000]. 100 cd/m^2 are about 256 units.
[[nodiscard]] double pu21_encode(double luminance);

/// `pu21_encode` of each value times `scale`.
[[nodiscard]] std::vector<float> pu21_encode(std::span<const float> luminances, double scale);

/// Display values of linear ones, as sRGB encodes them; those outside of [0, 1] are clamped.
[[nodiscard]] std::vector<float> srgb_encode(std::span<const float> linear);

}  // namespace weft

#endif
