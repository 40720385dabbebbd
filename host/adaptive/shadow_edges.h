// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_SHADOW_EDGES_H
#define WEFT_ADAPTIVE_SHADOW_EDGES_H

#include <cstdint>
#include <span>
#include <vector>

#include "plan/tile_masks.h"

namespace weft {

/// Where area lights are sampled with further shadow rays, decided from the probes.
struct ShadowEdges {
    std::vector<Level> levels;  ///< by tile, the highest of its pixels
    std::uint64_t pixels = 0;   ///< number of those at the edge of a shadow, which may be refined
};

/// Level of one of the `pixels` of an image: full where any light may be refined by further shadow
/// rays, coarse where the probes are all. `words`: what shadow_edges.cl wrote, for every 32 lights
/// a plane of one word a pixel.
[[nodiscard]] Level shadow_level(std::span<const std::uint32_t> words, std::size_t pixels,
                                 std::size_t pixel);

/// Finds the shadow edges of an image from the same words.
[[nodiscard]] ShadowEdges find_shadow_edges(const TileGrid& grid,
                                            std::span<const std::uint32_t> words);

}  // namespace weft

#endif
