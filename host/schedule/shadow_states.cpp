// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "schedule/shadow_states.h"

#include <algorithm>

namespace weft {
namespace {

constexpr unsigned open_shift = 16;

}  // namespace

std::uint32_t shadow_groups(std::uint32_t lights) {
    return std::clamp(lights, 1U, SHADOW_GROUPS);
}

ShadowState traced_state(std::uint32_t groups) {
    return {static_cast<std::uint16_t>((1U << groups) - 1U), 0, 0};
}

std::vector<ShadowState> shadow_states(std::span<const shared::TileShadows> tiles,
                                       std::uint32_t groups) {
    const std::uint32_t all = traced_state(groups).trace;
    std::vector<ShadowState> states;
    states.reserve(tiles.size());
    for (const shared::TileShadows& tile : tiles) {
        const std::uint32_t open = tile.seen & ~tile.hidden & tile.open;
        states.push_back({static_cast<std::uint16_t>(tile.seen & ~open & all),
                          static_cast<std::uint16_t>(open & all),
                          static_cast<std::uint16_t>(tile.seen & tile.hidden & ~tile.plain & all)});
    }
    return states;
}

std::vector<Level> shadow_levels(std::span<const ShadowState> states) {
    std::vector<Level> levels;
    levels.reserve(states.size());
    for (const ShadowState& state : states) {
        const bool unknown = (state.trace & ~state.penumbra) != 0;
        levels.push_back(unknown               ? Level::full
                         : state.penumbra != 0 ? Level::middle
                                               : Level::coarse);
    }
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
