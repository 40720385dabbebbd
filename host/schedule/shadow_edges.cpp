// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "schedule/shadow_edges.h"

#include <algorithm>

namespace weft {

std::vector<std::uint32_t> pixel_blocks(const WorkList& work, std::size_t pixels) {
    std::vector<std::uint32_t> blocks(pixels, 0);
    for (std::size_t slot = 0; slot < work.pixels.size(); ++slot)
        if (work.pixels[slot] != NO_TRIANGLE)
            blocks[work.pixels[slot]] = static_cast<std::uint32_t>(slot / PACKET_BLOCK);
    return blocks;
}

ShadowEdges find_shadow_edges(const TileGrid& grid, std::span<const std::uint32_t> edges,
                              std::span<const std::uint32_t> pixel_block, std::uint32_t blocks) {
    ShadowEdges found;
    found.levels.assign(grid.tiles(), Level::coarse);
    std::vector<std::uint8_t> marked(blocks, 0);
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        Level* const levels = found.levels.data() + std::size_t{y / TILE_EDGE} * grid.columns();
        for (std::uint32_t left = 0; left < grid.width; left += TILE_EDGE) {
            const std::size_t first = std::size_t{y} * grid.width + left;
            const std::uint32_t count = std::min<std::uint32_t>(TILE_EDGE, grid.width - left);
            std::uint32_t any = 0;
            for (std::uint32_t i = 0; i < count; ++i) any |= edges[first + i];
            if (any == 0) continue;
            levels[left / TILE_EDGE] = Level::full;
            for (std::uint32_t i = 0; i < count; ++i) {
                if (edges[first + i] == 0) continue;
                marked[pixel_block[first + i]] = 1;
                ++found.pixels;
            }
        }
    }
    for (std::uint32_t block = 0; block < blocks; ++block)
        if (marked[block] != 0) found.blocks.push_back(block);
    return found;
}

}  // namespace weft
