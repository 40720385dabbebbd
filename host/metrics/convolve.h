// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_CONVOLVE_H
#define WEFT_METRICS_CONVOLVE_H

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// `plane` filtered with `across` along its rows and `down` along its columns. Both have an odd
/// number of taps, and tap k of n weighs the pixel k - n/2 further on; beyond an edge its last
/// pixel is repeated. Costs one multiplication a pixel and tap; runs on all cores, with the same
/// result on any number of them.
[[nodiscard]] std::vector<float> convolve(std::span<const float> plane, std::uint32_t width,
                                          std::uint32_t height, std::span<const float> across,
                                          std::span<const float> down);

}  // namespace weft

#endif
