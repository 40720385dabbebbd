// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_HALF_ERRORS_REFERENCE_HALVES_H
#define WEFT_BENCH_HALF_ERRORS_REFERENCE_HALVES_H

#include <string>

#include "image/image.h"

namespace weft::bench {

/// An error and how far it may be off because references have noise of their own.
struct HalvesError {
    double relmse = 0.0;
    double interval = 0.0;  ///< with 95 %, the true one is that far away at most
};

/// relMSE of an image, without what the noise of references adds to it: the mean over pixels and
/// channels of (x - a) (x - b) / (r^2 + 0.01 mean(r)^2), where a and b are independent references
/// of the same expectation, and r their mean. Their noise is as often of one sign as of the other
/// in the product, so that the mean may even be a little below 0. The variance of a pixel's product
/// is estimated by ((x - r) (a - b))^2, summed over its channels before it is squared, since the
/// noise of these comes from the same paths.
///
/// Throws Error (exit code 2) where the images are not of one size or have no colours; `name` is
/// that of the file in messages.
[[nodiscard]] HalvesError halves_error(const Image& image, const Image& first, const Image& second,
                                       const std::string& name);

/// The mean of both halves, of their colours alone.
[[nodiscard]] Image mean_of_halves(const Image& first, const Image& second,
                                   const std::string& name);

}  // namespace weft::bench

#endif
