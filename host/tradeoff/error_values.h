// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_ERROR_VALUES_H
#define WEFT_TRADEOFF_ERROR_VALUES_H

#include <vector>

#include "image/image.h"
#include "tradeoff/tradeoff_result.h"

namespace weft {

/// How far the beauty of a picture is from that of the reference, by ErrorMeasure. Throws Error
/// (exit code 2) where one lacks it, the sizes differ, or the reference is black all over, which
/// leaves nothing to compare with.
[[nodiscard]] std::vector<double> error_values(const Image& reference, const Image& picture);

/// HDR-FLIP by pixel, row-major. Throws as error_values.
[[nodiscard]] std::vector<float> error_map(const Image& reference, const Image& picture);

/// The same layer as a picture of its own, named as beauty is. Throws Error (exit code 2) where it
/// is missing.
[[nodiscard]] Image layer_as_beauty(const Image& image, const char* name);

}  // namespace weft

#endif
