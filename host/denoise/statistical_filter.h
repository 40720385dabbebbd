// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_STATISTICAL_FILTER_H
#define WEFT_DENOISE_STATISTICAL_FILTER_H

#include <cstdint>
#include <vector>

#include "denoise/denoise_view.h"
#include "image/image.h"

namespace weft {

/// The beauty of an image, three planes, with less noise: the light that each pixel reflects is
/// averaged over those pixels near it that show the same surface and whose light Welch's t-test
/// does not tell from its own, by the layer "variance". `samples` of every pixel, 2 and up. Also
/// reads the layers emission, albedo, normal and depth; throws std::invalid_argument where one is
/// missing. The result does not depend on the number of threads.
[[nodiscard]] std::vector<float> statistical_filter(const Image& image, std::uint64_t samples,
                                                    const DenoiseView& view);

}  // namespace weft

#endif
