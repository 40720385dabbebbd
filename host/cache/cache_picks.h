// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_CACHE_PICKS_H
#define WEFT_CACHE_CACHE_PICKS_H

#include <cstdint>
#include <span>
#include <vector>

#include "plan/tile_masks.h"

namespace weft {

/// Edges of the squares of pixels in which each round of an irradiance cache places one record at
/// most, where a pixel of the square lacks irradiance. After the last round none does.
inline constexpr std::uint32_t cache_rounds[] = {16, 8, 4, 2, 1};

/// Of every square of `edge` x `edge` pixels that has any pixel in `missing`, the one nearest to
/// its centre, the first of several; row by row of squares. `edge` is above 0.
[[nodiscard]] std::vector<std::uint32_t> pick_missing(const TileGrid& grid,
                                                      std::span<const TileMask> missing,
                                                      std::uint32_t edge);

}  // namespace weft

#endif
