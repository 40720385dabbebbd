// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_LEVEL_OVERLAY_H
#define WEFT_ADAPTIVE_LEVEL_OVERLAY_H

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace weft {

/// Errors, in just noticeable differences, at both ends of an overlay's logarithmic colour scale.
inline constexpr double darkest_error = 0.5;
inline constexpr double brightest_error = 128.0;

/// The layers of an image that overlays are made of: those that add_level_layers added.
[[nodiscard]] std::vector<std::string> overlay_layers(const Image& image);

/// Whether a layer of that name is one that overlays are made of.
[[nodiscard]] bool is_overlay_layer(std::string_view name);

/// Shows a number of each pixel on its image: the image in grey, at an exposure of 2^exposure_ev,
/// half covered by the colours of viridis for the number that `of` has for a row-major index, from
/// 0 to 1, or not covered where it has none. Linear values for `write_png` without exposure.
[[nodiscard]] Image value_overlay(const Image& image,
                                  const std::function<std::optional<double>(std::size_t)>& of,
                                  double exposure_ev);

/// Shows a layer of overlay_layers on its image: the image in grey, at an exposure of
/// 2^exposure_ev, half covered by the colours of viridis for the layer's levels (coarse to full),
/// samples (one or none) or errors. Errors of 0, where nothing was judged, leave the image grey.
/// Linear values for `write_png` without exposure.
[[nodiscard]] Image level_overlay(const Image& image, const std::string& layer, double exposure_ev);

}  // namespace weft

#endif
