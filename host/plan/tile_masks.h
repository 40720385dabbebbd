// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_TILE_MASKS_H
#define WEFT_PLAN_TILE_MASKS_H

#include <cstdint>
#include <span>
#include <vector>

#include "shared/shared_types.h"

namespace weft {

/// The pixels of one tile of TILE_EDGE x TILE_EDGE: bit 8 y + x.
using TileMask = std::uint64_t;

/// How densely a tile is sampled: every 4th, every 2nd or every pixel of a row and column.
enum class Level : std::uint8_t { coarse = 0, middle = 1, full = 2 };

/// Pixels from one sample to the next: 4, 2 or 1.
[[nodiscard]] constexpr std::uint32_t stride_of(Level level) {
    return 4U >> static_cast<unsigned>(level);
}

/// The tiles of an image, row by row; those at the right and lower border may reach beyond it.
struct TileGrid {
    std::uint32_t width = 0;  ///< of the image, pixels
    std::uint32_t height = 0;

    [[nodiscard]] std::uint32_t columns() const { return (width + TILE_EDGE - 1) / TILE_EDGE; }
    [[nodiscard]] std::uint32_t rows() const { return (height + TILE_EDGE - 1) / TILE_EDGE; }
    [[nodiscard]] std::uint32_t tiles() const { return columns() * rows(); }
};

/// Lattice points of a tile at that level.
[[nodiscard]] TileMask lattice_mask(Level level);

/// Pixels of each tile in `masks` and all their neighbours, also in other tiles: each mask grows by
/// one pixel in every direction.
[[nodiscard]] std::vector<TileMask> dilated(const TileGrid& grid, std::span<const TileMask> masks);

/// Pixels in the discontinuity buffer's footprints about those in `masks`: as `dilated`, but
/// footprints at the image's border are moved inwards.
[[nodiscard]] std::vector<TileMask> footprint_masks(const TileGrid& grid,
                                                    std::span<const TileMask> masks);

/// Pixels of each tile that must have samples so that all tiles can be reconstructed at these
/// levels: its own lattice points, and those of its neighbours' lattices within reach of their
/// taps. The coarse lattice is always there. Raising a tile from the coarse level only adds pixels;
/// a full one needs fewer pixels of its neighbours than one at middle level.
[[nodiscard]] std::vector<TileMask> required_masks(const TileGrid& grid,
                                                   std::span<const Level> levels);

/// The mask of both words that the device has of it.
[[nodiscard]] constexpr TileMask mask_of(const std::uint32_t (&words)[2]) {
    return TileMask{words[1]} << 32 | words[0];
}

}  // namespace weft

#endif
