// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_IMAGES_H
#define WEFT_TRADEOFF_PAGE_IMAGES_H

#include <string>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// The section with a thumbnail of every point of the front, the reference beside it, and its map
/// of errors, all maps on one scale.
[[nodiscard]] std::string images_section(const TradeoffResult& result);

/// An image that the page shows for the first time, as an SVG element of its thumbnail; empty
/// where there is no image. `id` is markup, `alt` plain text.
[[nodiscard]] std::string shown_image(const Image& image, double exposure_ev, const std::string& id,
                                      const std::string& alt);

/// Shows again an image that images_section shows: that of the front with this place in front_of,
/// and the reference. Empty where there is none.
[[nodiscard]] std::string front_image_again(const TradeoffResult& result, std::size_t place,
                                            const std::string& alt);
[[nodiscard]] std::string reference_again(const TradeoffResult& result);

}  // namespace weft

#endif
