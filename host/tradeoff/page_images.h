// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_IMAGES_H
#define WEFT_TRADEOFF_PAGE_IMAGES_H

#include <nlohmann/json.hpp>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// What the page's template needs of the reference, of the points of the front (`cards`, each with
/// thumbnails of its image, the reference and its map of errors), and of the scale of all maps.
[[nodiscard]] nlohmann::json images_values(const TradeoffResult& result);

/// What it needs to compare other renderers with Weft's best setting for the same time, for each of
/// their budgets; false where there are no other renderers and no notes on them. Refers to images
/// of images_values, so that their bytes are in the page only once.
[[nodiscard]] nlohmann::json equal_time_values(const TradeoffResult& result,
                                               const nlohmann::json& images);

}  // namespace weft

#endif
