// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_ERROR_VALUES_H
#define WEFT_TRADEOFF_ERROR_VALUES_H

#include <optional>
#include <vector>

#include "image/image.h"
#include "metrics/unbiased_mse.h"
#include "tradeoff/tradeoff_result.h"

namespace weft {

/// Errors of the beauty layer of an image against that of the reference, by ErrorMeasure. Throws
/// Error (exit code 2) where one lacks the layer, the sizes differ, or the reference is black all
/// over, so that relative errors have no value.
[[nodiscard]] std::vector<double> error_values(const Image& reference, const Image& image);

/// The unbiased relative squared error of the beauty layer of an image, from the halves that the
/// reference holds as layers; none where it holds none. Throws as error_values.
[[nodiscard]] std::optional<ErrorEstimate> unbiased_value(const Image& reference,
                                                          const Image& image);

/// What the noise of a reference adds to relMSE, from the halves that it holds as layers; none
/// where it holds none or is black all over. Above most_noise_relmse intervals of unbiased_value
/// are too narrow.
[[nodiscard]] std::optional<double> noise_relmse_of(const Image& reference);

/// HDR-FLIP by pixel, row-major. Throws as error_values.
[[nodiscard]] std::vector<float> error_map(const Image& reference, const Image& image);

/// The layer `name` as an image of its own, as its beauty layer. Throws Error (exit code 2) where
/// it is missing.
[[nodiscard]] Image layer_as_beauty(const Image& image, const char* name);

}  // namespace weft

#endif
