// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_IMAGE_NOISE_H
#define WEFT_BENCH_PATH_IMAGE_NOISE_H

#include <vector>

#include "bench/path/ratio.h"

namespace weft::bench {

/// Independent images of one candidate, as many values in each.
using Images = std::vector<std::vector<float>>;

/// Of each value over some images.
struct Moments {
    std::vector<double> mean;
    std::vector<double> variance;  ///< unbiased, of one image
};

/// Takes at least two images.
[[nodiscard]] Moments moments(const Images& images);

/// What the variance of each value is set against: the square of the mean over `means`, plus 1 % of
/// the squared mean of the whole image, so that dark pixels do not outweigh all else. `means`: mean
/// images, one of each algorithm, so that a rare bright path weighs as much whoever has met it.
[[nodiscard]] std::vector<double> noise_scale(const std::vector<std::vector<double>>& means);

/// The variance of one image over the scale, averaged over all values. The spread is the
/// jackknife's over the images; takes at least three.
[[nodiscard]] Ratio relative_variance(const Images& images, const std::vector<double>& scale);

}  // namespace weft::bench

#endif
