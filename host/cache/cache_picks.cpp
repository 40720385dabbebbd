// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/cache_picks.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace weft {
namespace {

constexpr std::uint64_t no_square = std::numeric_limits<std::uint64_t>::max();

/// Orders the pixels of a square: by distance from its centre, then by index.
std::uint64_t rank(std::uint32_t x, std::uint32_t y, std::uint32_t edge, std::uint32_t pixel) {
    const auto from_centre = [edge](std::uint32_t at) {
        const std::int64_t twice = 2 * std::int64_t{at % edge} + 1 - std::int64_t{edge};
        return static_cast<std::uint64_t>(twice * twice);
    };
    return (from_centre(x) + from_centre(y)) << 32 | pixel;
}

}  // namespace

std::vector<std::uint32_t> pick_missing(const TileGrid& grid, std::span<const TileMask> missing,
                                        std::uint32_t edge) {
    const std::uint32_t columns = (grid.width + edge - 1) / edge;
    const std::uint32_t rows = (grid.height + edge - 1) / edge;
    std::vector<std::uint64_t> best(std::size_t{columns} * rows, no_square);
    for (std::uint32_t tile = 0; tile < missing.size(); ++tile) {
        for (TileMask left = missing[tile]; left != 0; left &= left - 1) {
            const auto bit = static_cast<std::uint32_t>(std::countr_zero(left));
            const std::uint32_t x = tile % grid.columns() * TILE_EDGE + bit % TILE_EDGE;
            const std::uint32_t y = tile / grid.columns() * TILE_EDGE + bit / TILE_EDGE;
            if (x >= grid.width || y >= grid.height) continue;
            std::uint64_t& square = best[std::size_t{y / edge} * columns + x / edge];
            square = std::min(square, rank(x, y, edge, y * grid.width + x));
        }
    }
    std::vector<std::uint32_t> picks;
    for (const std::uint64_t square : best)
        if (square != no_square) picks.push_back(static_cast<std::uint32_t>(square));
    return picks;
}

}  // namespace weft
