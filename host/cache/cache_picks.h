// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_CACHE_PICKS_H
#define WEFT_CACHE_CACHE_PICKS_H

#include <cstdint>
#include <span>
#include <vector>

#include "plan/tile_masks.h"

namespace weft {

/// Edges, in pixels, of the squares in which the rounds of an irradiance cache place records: one
/// in each square in which a pixel lacks irradiance. After the last round no pixel does.
inline constexpr std::uint32_t cache_rounds[] = {16, 8, 4, 2, 1};

/// Picks the places of records: of every square of `edge` x `edge` pixels that has any pixel in
/// `missing`, the one nearest to its centre, the first of several; row by row of squares. `edge`
/// is above 0.
[[nodiscard]] std::vector<std::uint32_t> pick_missing(const TileGrid& grid,
                                                      std::span<const TileMask> missing,
                                                      std::uint32_t edge);

}  // namespace weft

#endif
