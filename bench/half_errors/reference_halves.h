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

/// relMSE of an image, without what the noise of references adds to it (unbiased_errors), against
/// two independent references with as many samples each. Throws Error (exit code 2) where the
/// images are not of one size or have no colours, or where the references are black; `name` is that
/// of the file in messages.
[[nodiscard]] HalvesError halves_error(const Image& image, const Image& first, const Image& second,
                                       const std::string& name);

/// The mean of both halves, of their colours alone.
[[nodiscard]] Image mean_of_halves(const Image& first, const Image& second,
                                   const std::string& name);

}  // namespace weft::bench

#endif
