// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/tile_masks.h"

#include <algorithm>
#include <array>
#include <bit>

namespace weft {
namespace {

constexpr int edge = TILE_EDGE;

constexpr TileMask bit_of(int x, int y) {
    return TileMask{1} << (edge * y + x);
}

/// Lattice points of stride `stride` in the tile at (column, row) relative to one whose
/// reconstruction needs them: taps reach one lattice point before its first pixel and past the
/// last lattice point two more, the second only where a pixel lies between lattice points.
constexpr TileMask needed_by_neighbour(int stride, int column, int row) {
    const int before = stride;
    const int after = stride == 1 ? 1 : 2 * stride;
    const int last = (edge - 1) / stride * stride;
    TileMask mask = 0;
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x) {
            const int u = column * edge + x;
            const int v = row * edge + y;
            const bool on_lattice = x % stride == 0 && y % stride == 0;
            const bool near =
                u >= -before && u <= last + after && v >= -before && v <= last + after;
            if (on_lattice && near) mask |= bit_of(x, y);
        }
    return mask;
}

using Neighbourhood = std::array<TileMask, 9>;  // of the tile itself and its eight neighbours

constexpr Neighbourhood neighbourhood(int stride) {
    Neighbourhood masks{};
    for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column)
            masks[static_cast<std::size_t>(3 * (row + 1) + column + 1)] =
                needed_by_neighbour(stride, column, row);
    return masks;
}

constexpr std::array<Neighbourhood, 3> neighbourhoods{neighbourhood(4), neighbourhood(2),
                                                      neighbourhood(1)};

constexpr TileMask column_mask(int x) {
    TileMask mask = 0;
    for (int y = 0; y < edge; ++y) mask |= bit_of(x, y);
    return mask;
}

/// Calls use(neighbour's index, column, row) for the tile and those of its neighbours that exist.
template <class Use>
void for_neighbours(const TileGrid& grid, std::uint32_t tile, const Use& use) {
    const auto columns = static_cast<int>(grid.columns());
    const auto rows = static_cast<int>(grid.rows());
    const int x = static_cast<int>(tile) % columns;
    const int y = static_cast<int>(tile) / columns;
    for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column) {
            const int u = x + column;
            const int v = y + row;
            if (u < 0 || v < 0 || u >= columns || v >= rows) continue;
            use(static_cast<std::size_t>(v * columns + u), column, row);
        }
}

/// The pixels in `mask` and their left and right neighbours within the tile.
constexpr TileMask widened(TileMask mask) {
    return mask | (mask & ~column_mask(edge - 1)) << 1 | (mask & ~column_mask(0)) >> 1;
}

/// The part of `mask`, grown by one pixel, that falls into the tile at (column, row) beside it.
constexpr TileMask spilled(TileMask mask, int column, int row) {
    TileMask part = widened(mask);
    if (column > 0) part = (mask & column_mask(edge - 1)) >> (edge - 1);
    if (column < 0) part = (mask & column_mask(0)) << (edge - 1);
    if (row > 0) return part >> (edge * (edge - 1));
    if (row < 0) return part << (edge * (edge - 1));
    return part | part << edge | part >> edge;
}

/// The pixel, or the next one that is not the first or last of `size`.
constexpr std::uint32_t inwards(std::uint32_t at, std::uint32_t size) {
    return size < 3 ? at : std::clamp(at, 1U, size - 2);
}

using Lattices = std::uint8_t;  // a bit per level

/// The lattices that each tile needs in itself and about it. Where the image cuts off the last tile
/// at its right or lower border, taps and footprints of that tile move inwards, into the tile
/// before: then this one needs the samples of both levels.
std::vector<Lattices> lattices_with_borders(const TileGrid& grid, std::span<const Level> levels) {
    std::vector<Lattices> result;
    result.reserve(levels.size());
    for (const Level level : levels)
        result.push_back(static_cast<Lattices>(1U << static_cast<unsigned>(level)));
    const std::uint32_t columns = grid.columns();
    const auto share = [&](std::uint32_t tile, std::uint32_t from) {
        result[tile] = static_cast<Lattices>(result[tile] | result[from]);
    };
    if (grid.width % TILE_EDGE != 0 && columns > 1)
        for (std::uint32_t row = 0; row < grid.rows(); ++row)
            share(row * columns + columns - 2, row * columns + columns - 1);
    if (grid.height % TILE_EDGE != 0 && grid.rows() > 1)
        for (std::uint32_t column = 0; column < columns; ++column)
            share((grid.rows() - 2) * columns + column, (grid.rows() - 1) * columns + column);
    return result;
}

}  // namespace

TileMask lattice_mask(Level level) {
    return neighbourhoods.at(static_cast<std::size_t>(level))[4];
}

std::vector<TileMask> dilated(const TileGrid& grid, std::span<const TileMask> masks) {
    std::vector<TileMask> result(masks.size(), 0);
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
        if (masks[tile] == 0) continue;
        for_neighbours(grid, tile, [&](std::size_t other, int column, int row) {
            // A corner spills just one pixel, which the two shifts of `spilled` ensure.
            result[other] |= spilled(masks[tile], column, row);
        });
    }
    return result;
}

std::vector<TileMask> footprint_masks(const TileGrid& grid, std::span<const TileMask> masks) {
    // At the border a pixel's footprint is that of the next one inwards.
    std::vector<TileMask> centres(masks.begin(), masks.end());
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
        const std::uint32_t left = tile % grid.columns() * TILE_EDGE;
        const std::uint32_t top = tile / grid.columns() * TILE_EDGE;
        const bool within =
            left > 0 && top > 0 && left + TILE_EDGE < grid.width && top + TILE_EDGE < grid.height;
        for (TileMask rest = within ? 0 : masks[tile]; rest != 0; rest &= rest - 1) {
            const auto bit = static_cast<std::uint32_t>(std::countr_zero(rest));
            const std::uint32_t x = inwards(left + bit % TILE_EDGE, grid.width);
            const std::uint32_t y = inwards(top + bit / TILE_EDGE, grid.height);
            centres[y / TILE_EDGE * grid.columns() + x / TILE_EDGE] |=
                bit_of(static_cast<int>(x % TILE_EDGE), static_cast<int>(y % TILE_EDGE));
        }
    }
    return dilated(grid, centres);
}

std::vector<TileMask> required_masks(const TileGrid& grid, std::span<const Level> levels) {
    const std::vector<Lattices> lattices = lattices_with_borders(grid, levels);
    std::vector<TileMask> result(levels.size(), lattice_mask(Level::coarse));
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
        for (std::size_t level = 1; level < neighbourhoods.size(); ++level) {
            if ((lattices[tile] >> level & 1U) == 0) continue;
            const Neighbourhood& needed = neighbourhoods[level];
            for_neighbours(grid, tile, [&](std::size_t other, int column, int row) {
                result[other] |= needed[static_cast<std::size_t>(3 * (row + 1) + column + 1)];
            });
        }
    return result;
}

}  // namespace weft
