// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "schedule/work_list.h"

#include <algorithm>
#include <bit>

#include "device/shared_types.h"

namespace weft {
namespace {

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

}  // namespace

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
                while (list.pixels.size() % PACKET_BLOCK != 0) list.pixels.push_back(NO_TRIANGLE);
                list.block_sets.resize(list.pixels.size() / PACKET_BLOCK, set);
            }
    return list;
}

}  // namespace weft
