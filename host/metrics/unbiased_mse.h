// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_UNBIASED_MSE_H
#define WEFT_METRICS_UNBIASED_MSE_H

#include <optional>
#include <span>

#include "metrics/rgb_view.h"

namespace weft {

/// Two images of one view whose noise is independent, such as path-traced ones of different random
/// numbers.
struct ReferenceHalves {
    RgbView first;
    RgbView second;
    double first_share = 0.5;  ///< of the samples of both that are the first's, in (0, 1)
};

/// An error, and the interval that holds the true one with a confidence of 95 %.
struct ErrorEstimate {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// The largest UnbiasedErrors::noise_relmse for which intervals of the relMSE are as wide as they
/// have to be: relative noise of 7 %.
inline constexpr double most_noise_relmse = 0.005;

/// Squared errors of an image against what the halves are noisy images of. They may be negative
/// where the image is nearer to that than the noise tells apart.
struct UnbiasedErrors {
    /// mean of (x - a)(x - b) over pixels and channels, for the image x and the halves a and b
    ErrorEstimate mse;
    /// the same with each value divided by m^2 + 0.01 mean(m)^2, where m is the mean of the samples
    /// of both halves; empty where m is black and something else is not
    std::optional<ErrorEstimate> relmse;
    double noise_mse = 0.0;              ///< estimated variance of m, the mean over all values
    std::optional<double> noise_relmse;  ///< the same with each divided as in relmse
};

/// Estimates the errors of an image from two noisy references. With e the true error of a value,
/// and a, b the noise of the halves, (e - a)(e - b) has the mean e^2, because a and b have the mean
/// 0 and are independent, whatever their distributions and variances.
///
/// The interval is for this image: x is what it is, the references are random. The variance of
/// (e - a)(e - b) is e^2 (A + B) + A B, with A and B the variances of the halves. It is estimated
/// by (x - m)^2 (a - b)^2, whose mean it is for Gaussian noise with A and B in inverse ratio to the
/// samples, as first_share has it: m and a - b are independent then, the mean of (x - m)^2 is
/// e^2 + A B / (A + B), and that of (a - b)^2 is A + B. A wrong first_share makes intervals wider
/// than needed, and so does noise with an excess kurtosis k, by k A^2 / 2. Skewed noise makes them
/// wider where an image is too dark, and narrower where it is too bright. Pixels have to be
/// independent of each other; channels need not be, since those of a pixel are added up before they
/// are squared. The reach is a quantile of Student's distribution, whose degrees of freedom say
/// from how many pixels the variance comes.
///
/// The divisor of the relMSE depends on the noise of m. With f(m) = (x - m)^2 / (m^2 + eps), each
/// value adds f - v f'' / 2, where v = (a - b)^2 / 4 estimates the variance of m, for equal numbers
/// of samples; what is left is of the second order in the relative variance of m. Where
/// noise_relmse is above most_noise_relmse, intervals of the relMSE are too narrow.
///
/// Throws std::invalid_argument unless all have one size and first_share is in its range; values
/// have to be finite.
[[nodiscard]] UnbiasedErrors unbiased_errors(const ReferenceHalves& reference, const RgbView& test);

/// The mean error of several images that were compared with the same halves, whose estimates
/// therefore err alike: the means of values and of ends of intervals. None give 0.
[[nodiscard]] ErrorEstimate mean_estimate(std::span<const ErrorEstimate> estimates);

}  // namespace weft

#endif
