// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCHEDULE_SHADOW_EDGES_H
#define WEFT_SCHEDULE_SHADOW_EDGES_H

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "schedule/tile_masks.h"
#include "schedule/work_list.h"

namespace weft {

/// Where shadows of area lights are sampled in full, decided from what one ray to each light found.
struct ShadowEdges {
    std::vector<std::uint32_t> blocks;  ///< of the work list, to be sampled again; rising
    std::vector<Level> levels;          ///< by tile: full where it has such a pixel, else coarse
    std::uint64_t pixels = 0;           ///< close to the end of a shadow
};

/// Block of the work list that each pixel belongs to.
[[nodiscard]] std::vector<std::uint32_t> pixel_blocks(const WorkList& work, std::size_t pixels);

/// `edges`: what shadow_edges.cl wrote, a word a pixel, 0 where all about it saw the same;
/// `pixel_block`: of the picture's work list of `blocks` blocks.
[[nodiscard]] ShadowEdges find_shadow_edges(const TileGrid& grid,
                                            std::span<const std::uint32_t> edges,
                                            std::span<const std::uint32_t> pixel_block,
                                            std::uint32_t blocks);

}  // namespace weft

#endif
