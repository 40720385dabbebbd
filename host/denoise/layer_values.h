// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_LAYER_VALUES_H
#define WEFT_DENOISE_LAYER_VALUES_H

#include <cstddef>
#include <span>
#include <string_view>

#include "image/image.h"

namespace weft {

/// The first `channels` planes of an image's layer. Throws std::invalid_argument where there is no
/// such layer, or it has fewer.
[[nodiscard]] std::span<const float> layer_values(const Image& image, std::string_view name,
                                                  std::size_t channels);

}  // namespace weft

#endif
