// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_HEAT_MAP_H
#define WEFT_METRICS_HEAT_MAP_H

#include <array>
#include <cstdint>
#include <span>

#include "image/image.h"

namespace weft {

/// The colour of a value in [0, 1], clamped, as 8-bit sRGB: viridis, from dark violet by way of
/// green to yellow, whose lightness grows with the value and which reads the same without colour
/// vision.
[[nodiscard]] std::array<std::uint8_t, 3> viridis(double value);

/// An image of a map of width x height values, `high` and above being brightest, with a scale bar
/// and its end values 0 and `high` below. It is wider than the map where the numbers need it.
/// Linear values: `write_png` without exposure gives exactly the colours of `viridis`. Throws
/// std::invalid_argument unless there is a value a pixel and `high` is finite and above 0.
[[nodiscard]] Image heat_map(std::span<const float> values, std::uint32_t width,
                             std::uint32_t height, double high);

}  // namespace weft

#endif
