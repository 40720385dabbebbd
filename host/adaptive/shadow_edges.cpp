// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/shadow_edges.h"

#include <algorithm>

#include "shared/shared_types.h"

namespace weft {

Level shadow_level(std::span<const std::uint32_t> words, std::size_t pixels, std::size_t pixel) {
    std::uint32_t edges = 0;
    for (std::size_t at = pixel; at < words.size(); at += pixels) edges |= words[at];
    return edges != 0 ? Level::full : Level::coarse;
}

ShadowEdges find_shadow_edges(const TileGrid& grid, std::span<const std::uint32_t> words) {
    const std::size_t pixels = std::size_t{grid.width} * grid.height;
    ShadowEdges found;
    found.levels.assign(grid.tiles(), Level::coarse);
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        Level* const levels = found.levels.data() + std::size_t{y / TILE_EDGE} * grid.columns();
        for (std::uint32_t left = 0; left < grid.width; left += TILE_EDGE) {
            const std::size_t first = std::size_t{y} * grid.width + left;
            const std::size_t end = first + std::min<std::size_t>(TILE_EDGE, grid.width - left);
            for (std::size_t pixel = first; pixel < end; ++pixel) {
                const Level level = shadow_level(words, pixels, pixel);
                found.pixels += level == Level::full ? 1 : 0;
                levels[left / TILE_EDGE] = std::max(levels[left / TILE_EDGE], level);
            }
        }
    }
    return found;
}

}  // namespace weft
