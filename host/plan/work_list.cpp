// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/work_list.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "plan/halton.h"
#include "shared/shared_types.h"

namespace weft {
namespace {

constexpr std::uint32_t region_tiles = 16;  // along an edge

/// Every second bit of `code`, from bit 0.
std::uint32_t even_bits(std::uint64_t code) {
    std::uint32_t value = 0;
    for (std::uint32_t bit = 0; bit < 32; ++bit)
        value |= static_cast<std::uint32_t>(code >> (2 * bit) & 1U) << bit;
    return value;
}

struct Cell {
    std::uint32_t column, row;
};

/// The cells of a square grid of `edge` columns along a Morton curve.
std::vector<Cell> morton_order(std::uint32_t edge) {
    const std::uint64_t codes = std::uint64_t{std::bit_ceil(edge)} * std::bit_ceil(edge);
    std::vector<Cell> cells;
    cells.reserve(std::size_t{edge} * edge);
    for (std::uint64_t code = 0; code < codes; ++code) {
        const Cell cell{even_bits(code), even_bits(code >> 1)};
        if (cell.column < edge && cell.row < edge) cells.push_back(cell);
    }
    return cells;
}

/// The pixels of a tile that belong to each sample set, which depend on where the tile begins.
class SetMasks {
  public:
    explicit SetMasks(std::uint32_t interleave)
        : interleave_(interleave), masks_(std::size_t{interleave} * interleave * sets()) {
        for (std::uint32_t phase = 0; phase < sets(); ++phase)
            for (std::uint32_t bit = 0; bit < TILE_EDGE * TILE_EDGE; ++bit) {
                const std::uint32_t x = phase % interleave + bit % TILE_EDGE;
                const std::uint32_t y = phase / interleave + bit / TILE_EDGE;
                const std::uint32_t set = x % interleave + interleave * (y % interleave);
                masks_[phase * sets() + set] |= TileMask{1} << bit;
            }
    }

    [[nodiscard]] std::uint32_t sets() const { return interleave_ * interleave_; }
    /// `left`, `top`: the tile's first pixel.
    [[nodiscard]] TileMask of(std::uint32_t left, std::uint32_t top, std::uint32_t set) const {
        const std::uint32_t phase = left % interleave_ + interleave_ * (top % interleave_);
        return masks_[phase * sets() + set];
    }

  private:
    std::uint32_t interleave_;
    std::vector<TileMask> masks_;
};

/// Bits of a tile that lie in the image.
TileMask inside(const TileGrid& grid, std::uint32_t left, std::uint32_t top) {
    TileMask mask = 0;
    const std::uint32_t width = std::min<std::uint32_t>(TILE_EDGE, grid.width - left);
    const std::uint32_t height = std::min<std::uint32_t>(TILE_EDGE, grid.height - top);
    for (std::uint32_t y = 0; y < height; ++y)
        mask |= ((TileMask{1} << width) - 1) << (TILE_EDGE * y);
    return mask;
}

void pad(WorkList& list, std::uint32_t set) {
    while (list.pixels.size() % PACKET_BLOCK != 0) list.pixels.push_back(INVALID_INDEX);
    list.block_sets.resize(list.pixels.size() / PACKET_BLOCK, set);
}

}  // namespace

std::uint32_t work_regions(const TileGrid& grid) {
    return ((grid.columns() + region_tiles - 1) / region_tiles) *
           ((grid.rows() + region_tiles - 1) / region_tiles);
}

WorkList make_work_list(const TileGrid& grid, std::span<const TileMask> masks,
                        std::uint32_t interleave) {
    constexpr std::uint32_t region = region_tiles;
    const SetMasks set_masks(interleave);
    const std::vector<Cell> order = morton_order(region);
    WorkList list;
    std::vector<std::uint32_t> tiles;
    for (std::uint32_t row = 0; row < grid.rows(); row += region)
        for (std::uint32_t column = 0; column < grid.columns(); column += region) {
            tiles.clear();
            for (const Cell& cell : order) {
                const std::uint32_t x = column + cell.column;
                const std::uint32_t y = row + cell.row;
                if (x >= grid.columns() || y >= grid.rows()) continue;
                if (masks[y * grid.columns() + x] != 0) tiles.push_back(y * grid.columns() + x);
            }
            for (std::uint32_t set = 0; set < set_masks.sets() && !tiles.empty(); ++set) {
                for (const std::uint32_t tile : tiles) {
                    const std::uint32_t left = tile % grid.columns() * TILE_EDGE;
                    const std::uint32_t top = tile / grid.columns() * TILE_EDGE;
                    TileMask mask = masks[tile] & set_masks.of(left, top, set);
                    if (left + TILE_EDGE > grid.width || top + TILE_EDGE > grid.height)
                        mask &= inside(grid, left, top);
                    for (; mask != 0; mask &= mask - 1) {
                        const auto bit = static_cast<std::uint32_t>(std::countr_zero(mask));
                        list.pixels.push_back((top + bit / TILE_EDGE) * grid.width + left +
                                              bit % TILE_EDGE);
                    }
                }
                pad(list, set);
            }
        }
    return list;
}

WorkList make_work_list(std::uint32_t width, std::uint32_t height, std::uint32_t interleave,
                        std::uint32_t tile) {
    const std::uint32_t edge = std::min(tile, std::max(width, height));
    const std::vector<Cell> order = morton_order((edge + interleave - 1) / interleave);
    WorkList list;
    for (std::uint32_t top = 0; top < height; top += edge)
        for (std::uint32_t left = 0; left < width; left += edge)
            for (std::uint32_t set = 0; set < interleave * interleave; ++set) {
                // First column and row of the tile that belong to the set.
                const std::uint32_t column = set % interleave;
                const std::uint32_t row = set / interleave;
                const std::uint32_t x0 =
                    left + (column + interleave - left % interleave) % interleave;
                const std::uint32_t y0 = top + (row + interleave - top % interleave) % interleave;
                for (const Cell& cell : order) {
                    const std::uint32_t x = x0 + cell.column * interleave;
                    const std::uint32_t y = y0 + cell.row * interleave;
                    if (x < std::min(left + edge, width) && y < std::min(top + edge, height))
                        list.pixels.push_back(y * width + x);
                }
                pad(list, set);
            }
    return list;
}

WorkList make_spread_work_list(std::uint32_t width, std::uint32_t height, std::uint32_t interleave,
                               std::uint32_t tile) {
    const std::uint32_t spread = 2 * interleave;
    WorkList list = make_work_list(width, height, spread, tile);
    for (std::uint32_t& set : list.block_sets)
        set = set % spread % interleave + set / spread % interleave * interleave;
    return list;
}

WorkList make_shuffled_work_list(std::uint32_t width, std::uint32_t height,
                                 std::uint32_t interleave) {
    // As many blocks as sets.
    const std::uint32_t edge = 4 * interleave;
    static_assert(PACKET_BLOCK == 4 * 4);
    const std::uint32_t sets = interleave * interleave;
    // Squares that follow one another, so that neighbouring slots stay neighbours in the image.
    constexpr std::uint32_t together = 4;
    const std::vector<Cell> order = morton_order(together);
    WorkList list;
    std::vector<std::uint32_t> square;
    for (std::uint32_t top = 0; top < height; top += together * edge)
        for (std::uint32_t left = 0; left < width; left += together * edge)
            for (const Cell& cell : order) {
                square.clear();
                const std::uint32_t x0 = left + cell.column * edge;
                const std::uint32_t y0 = top + cell.row * edge;
                for (std::uint32_t y = y0; y < std::min(y0 + edge, height); ++y)
                    for (std::uint32_t x = x0; x < std::min(x0 + edge, width); ++x)
                        square.push_back(y * width + x);
                const auto block = static_cast<std::uint32_t>(list.block_sets.size());
                for (std::uint32_t k = static_cast<std::uint32_t>(square.size()); k > 1; --k) {
                    const std::uint64_t random = seed_of_sample(block, k);
                    std::swap(square[k - 1], square[random * k >> 32]);
                }
                std::uint32_t set = seed_of_sample(block, 0) % sets;
                for (std::size_t k = 0; k < square.size(); ++k) {
                    list.pixels.push_back(square[k]);
                    if ((k + 1) % PACKET_BLOCK != 0 && k + 1 < square.size()) continue;
                    pad(list, set);
                    set = (set + 1) % sets;
                }
            }
    return list;
}

}  // namespace weft
