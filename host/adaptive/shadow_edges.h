// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_SHADOW_EDGES_H
#define WEFT_ADAPTIVE_SHADOW_EDGES_H

#include <cstdint>
#include <span>
#include <vector>

#include "plan/tile_masks.h"

namespace weft {

/// How densely area lights are sampled, decided from what one ray to each light found.
struct ShadowEdges {
    std::vector<Level> levels;  ///< by tile, the highest of its pixels
    std::uint64_t pixels = 0;   ///< at the edge of a shadow, from where further rays may go
};

/// Of a pixel: full where further rays may go to any light, coarse where one look has to do.
/// `words`: what shadow_edges.cl wrote, a picture for every 32 lights.
[[nodiscard]] Level shadow_level(std::span<const std::uint32_t> words, std::size_t pixels,
                                 std::size_t pixel);

/// Of a picture.
[[nodiscard]] ShadowEdges find_shadow_edges(const TileGrid& grid,
                                            std::span<const std::uint32_t> words);

}  // namespace weft

#endif
