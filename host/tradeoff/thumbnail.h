// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_THUMBNAIL_H
#define WEFT_TRADEOFF_THUMBNAIL_H

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"

namespace weft {

/// The longest edge of a thumbnail, pixels.
inline constexpr std::uint32_t thumbnail_edge = 192;

/// The beauty layer with no edge longer than `edge`, each pixel the mean of what it covers of the
/// image's linear values (a box filter); small images stay as they are. Values that are not
/// finite count as 0. An image without layers where there is no beauty layer of the right size.
[[nodiscard]] Image scaled_down(const Image& image, std::uint32_t edge);

/// One value a pixel as an image of a single channel, scaled down likewise. An image without
/// layers unless there are width x height values.
[[nodiscard]] Image scaled_map(std::span<const float> values, std::uint32_t width,
                               std::uint32_t height, std::uint32_t edge);

/// An image of a map of a single channel in the colours of viridis, `high` and above brightest.
[[nodiscard]] Image map_colours(const Image& map, double high);

/// The end of a scale for all of these maps: the value that one percent of all their pixels exceed,
/// rounded up to 1, 2 or 5 times a power of ten; 1 where no value is above 0.
[[nodiscard]] double map_scale(std::span<const Image> maps);

/// The image times 2^exposure_ev as a `data:` URI of a PNG file; empty where there is none.
[[nodiscard]] std::string image_uri(const Image& image, double exposure_ev);

}  // namespace weft

#endif
