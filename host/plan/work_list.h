// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_WORK_LIST_H
#define WEFT_PLAN_WORK_LIST_H

#include <cstdint>
#include <span>
#include <vector>

#include "plan/tile_masks.h"

namespace weft {

/// Pixels in the order in which packets work on them: tile by tile, within a tile sample set by
/// sample set (interleaved sampling, Keller and Heidrich 2001), within a set along a Morton curve,
/// so that neighbouring slots are neighbouring pixels of one set.
struct WorkList {
    /// Pixel index per slot, or INVALID_INDEX for padding. A multiple of PACKET_BLOCK long.
    std::vector<std::uint32_t> pixels;
    /// Sample set of each block of PACKET_BLOCK slots.
    std::vector<std::uint32_t> block_sets;
};

/// Work list of an image with n x n interleaving: pixel (x, y) belongs to set
/// (x mod n) + n (y mod n). Every pixel appears exactly once, whatever `tile` (in pixels).
[[nodiscard]] WorkList make_work_list(std::uint32_t width, std::uint32_t height,
                                      std::uint32_t interleave, std::uint32_t tile);

/// The same pixels with the same sets, but a block holds pixels with the same place in squares of
/// 2 n x 2 n: every second one of its set in a row and column (probed_sample in
/// kernels/adaptive/visibility_mask.h).
[[nodiscard]] WorkList make_spread_work_list(std::uint32_t width, std::uint32_t height,
                                             std::uint32_t interleave, std::uint32_t tile);

/// Work list of an image that is not filtered over sets: squares of 4 n x 4 n pixels, each of which
/// is dealt at random to n x n blocks of different sets. So the errors that the pixels of a set
/// share look like noise, not like a grid. The same list each time.
[[nodiscard]] WorkList make_shuffled_work_list(std::uint32_t width, std::uint32_t height,
                                               std::uint32_t interleave);

/// Work list of the pixels in `masks` alone, one mask per tile of the grid; bits outside of the
/// image are left out. Ordered region by region, large squares of tiles whose packets are filled
/// together.
[[nodiscard]] WorkList make_work_list(const TileGrid& grid, std::span<const TileMask> masks,
                                      std::uint32_t interleave);

/// Regions of such a list; in each, every sample set is padded to whole packets.
[[nodiscard]] std::uint32_t work_regions(const TileGrid& grid);

}  // namespace weft

#endif
