// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_IMAGE_MASKS_H
#define WEFT_TESTS_TESTING_IMAGE_MASKS_H

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "plan/tile_masks.h"

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

#ifndef LANES
#define LANES 1
#endif
#undef WEFT_KERNELS_CORE_TYPES_H  // the host's structs are those of another namespace
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wpsabi"
namespace native {
#include "kernels/adaptive/lattice.h"
#include "kernels/film/discontinuity.h"
}  // namespace native
#pragma GCC diagnostic pop

namespace weft::test {

/// Images that end before, at and behind the end of tiles and lattices.
inline const std::vector<TileGrid>& small_images() {
    static const std::vector<TileGrid> images{
        {1, 1},   {2, 1},   {1, 9},   {3, 3},   {7, 5},    {8, 8},   {9, 17},  {10, 10},
        {12, 11}, {13, 23}, {16, 16}, {17, 25}, {23, 40},  {33, 15}, {64, 48}, {41, 49},
        {65, 2},  {5, 66},  {50, 51}, {52, 61}, {100, 33}, {18, 19}, {20, 35}, {134, 140}};
    return images;
}

/// Random numbers that every standard library makes alike.
class RandomBits {
  public:
    explicit RandomBits(std::uint32_t seed) : random_(seed) {}
    /// 0 ... end - 1.
    std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(random_()) % end; }
    TileMask mask() { return TileMask{random_()} << 32 | random_(); }
    /// [0, 1)
    float unit() { return static_cast<float>(below(1U << 24)) * 0x1p-24F; }

  private:
    std::mt19937 random_;
};

inline bool in_mask(const TileGrid& grid, const std::vector<TileMask>& masks, std::uint32_t x,
                    std::uint32_t y) {
    const std::uint32_t bit = y % TILE_EDGE * TILE_EDGE + x % TILE_EDGE;
    return (masks[y / TILE_EDGE * grid.columns() + x / TILE_EDGE] >> bit & 1U) != 0;
}

/// Calls use(x, y) for every pixel of the image whose sample counts in the reconstruction of the
/// pixel (x, y) at a stride, on one surface: by the kernels' own taps and footprints.
template <class Use>
void for_support(const TileGrid& grid, std::uint32_t x, std::uint32_t y, std::uint32_t stride,
                 const Use& use) {
    const auto width = static_cast<int>(grid.width);
    const auto height = static_cast<int>(grid.height);
    const auto at = [&](int u, int v) {
        if (u >= 0 && u < width && v >= 0 && v < height)
            use(static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v));
    };
    if (stride == 1) {
        const int left = native::footprint_start(static_cast<int>(x), 1, width);
        const int top = native::footprint_start(static_cast<int>(y), 1, height);
        for (int v = top; v < top + 3; ++v)
            for (int u = left; u < left + 3; ++u) at(u, v);
        return;
    }
    const auto step = static_cast<int>(stride);
    const native::LatticeTaps across = native::lattice_taps(static_cast<int>(x), step, width);
    const native::LatticeTaps down = native::lattice_taps(static_cast<int>(y), step, height);
    for (int j = 0; j < static_cast<int>(LATTICE_TAPS); ++j)
        for (int i = 0; i < static_cast<int>(LATTICE_TAPS); ++i)
            if (across.weight[i] * down.weight[j] != 0.0F)
                at((across.first + i) * step, (down.first + j) * step);
}

/// Each mask and all pixels beside its own, found one by one.
inline std::vector<TileMask> dilated_by_pixels(const TileGrid& grid,
                                               const std::vector<TileMask>& masks) {
    const auto columns = static_cast<int>(grid.columns());
    const auto rows = static_cast<int>(grid.rows());
    std::vector<TileMask> result(masks.size(), 0);
    for (int y = 0; y < rows * TILE_EDGE; ++y)
        for (int x = 0; x < columns * TILE_EDGE; ++x) {
            bool near = false;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rows * TILE_EDGE - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, columns * TILE_EDGE - 1); ++u)
                    near = near || in_mask(grid, masks, static_cast<std::uint32_t>(u),
                                           static_cast<std::uint32_t>(v));
            if (near)
                result[static_cast<std::size_t>(y / TILE_EDGE * columns + x / TILE_EDGE)] |=
                    TileMask{1} << (y % TILE_EDGE * TILE_EDGE + x % TILE_EDGE);
        }
    return result;
}

}  // namespace weft::test

#endif
