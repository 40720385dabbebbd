// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "schedule/shadow_states.h"

#include <algorithm>

namespace weft {
namespace {

constexpr unsigned open_shift = 16;

/// Groups that some sample of the tile or a neighbour saw, and did not see.
struct Nearby {
    std::uint32_t seen = 0;
    std::uint32_t hidden = 0;
};

Nearby nearby(const TileGrid& grid, std::span<const shared::TileShadows> tiles,
              std::uint32_t tile) {
    const std::uint32_t x = tile % grid.columns();
    const std::uint32_t y = tile / grid.columns();
    Nearby result;
    for (std::uint32_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, grid.rows() - 1); ++v)
        for (std::uint32_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, grid.columns() - 1); ++u) {
            result.seen |= tiles[v * grid.columns() + u].seen;
            result.hidden |= tiles[v * grid.columns() + u].hidden;
        }
    return result;
}

}  // namespace

std::uint32_t shadow_groups(std::uint32_t lights) {
    return std::clamp(lights, 1U, SHADOW_GROUPS);
}

ShadowState traced_state(std::uint32_t groups) {
    return {static_cast<std::uint16_t>((1U << groups) - 1U), 0};
}

std::vector<ShadowState> shadow_states(const TileGrid& grid,
                                       std::span<const shared::TileShadows> tiles,
                                       std::uint32_t groups) {
    const std::uint32_t all = traced_state(groups).trace;
    std::vector<ShadowState> states(tiles.size());
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
        const Nearby near = nearby(grid, tiles, tile);
        const std::uint32_t open = near.seen & ~near.hidden & tiles[tile].open;
        states[tile].trace = static_cast<std::uint16_t>(near.seen & ~open & all);
        states[tile].open = static_cast<std::uint16_t>(open & all);
    }
    return states;
}

std::vector<Level> shadow_levels(std::span<const ShadowState> states) {
    std::vector<Level> levels;
    levels.reserve(states.size());
    for (const ShadowState& state : states)
        levels.push_back(state.trace != 0 ? Level::full : Level::coarse);
    return levels;
}

std::vector<std::uint32_t> block_shadows(const TileGrid& grid, const WorkList& list,
                                         std::span<const ShadowState> states,
                                         std::uint32_t groups) {
    const std::uint32_t all = traced_state(groups).trace;
    std::vector<std::uint32_t> words;
    words.reserve(list.block_sets.size());
    for (std::size_t first = 0; first < list.pixels.size(); first += PACKET_BLOCK) {
        std::uint32_t open = all;
        std::uint32_t dark = all;
        for (std::size_t i = first; i < first + PACKET_BLOCK; ++i) {
            const std::uint32_t pixel = list.pixels[i];
            if (pixel == NO_TRIANGLE) continue;
            const std::uint32_t column = pixel % grid.width / TILE_EDGE;
            const std::uint32_t row = pixel / grid.width / TILE_EDGE;
            const ShadowState& state = states[row * grid.columns() + column];
            open &= state.open;
            dark &= ~(std::uint32_t{state.open} | state.trace);
        }
        words.push_back((all & ~(open | dark)) | open << open_shift);
    }
    return words;
}

}  // namespace weft
