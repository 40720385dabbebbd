// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/tile_masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "tests/testing/image_masks.h"

// Masks of tiles against reference implementations that go through the image pixel by pixel, and
// against the taps and footprints of the kernels that read what the masks select.
namespace weft::tile_masks_test {
namespace {

using test::in_mask;
using test::RandomBits;

std::string text_of(const TileGrid& grid) {
    return std::to_string(grid.width) + "x" + std::to_string(grid.height);
}

std::vector<Level> random_levels(const TileGrid& grid, RandomBits& random) {
    // Mostly coarse, so that single finer tiles stand alone, too.
    std::vector<Level> levels(grid.tiles());
    const std::uint32_t rare = 1 + random.below(6);
    for (Level& level : levels)
        level = random.below(rare) == 0 ? static_cast<Level>(random.below(3)) : Level::coarse;
    return levels;
}

/// Pixels of the image that a tile's reconstruction reads and the masks leave out.
std::size_t missing_support(const TileGrid& grid, const std::vector<Level>& levels,
                            const std::vector<TileMask>& masks) {
    std::size_t missing = 0;
    for (std::uint32_t y = 0; y < grid.height; ++y)
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const Level level = levels[y / TILE_EDGE * grid.columns() + x / TILE_EDGE];
            test::for_support(grid, x, y, stride_of(level), [&](std::uint32_t u, std::uint32_t v) {
                missing += in_mask(grid, masks, u, v) ? 0 : 1;
            });
        }
    return missing;
}

TEST(TileMasks, LatticesOfATile) {
    for (const Level level : {Level::coarse, Level::middle, Level::full}) {
        const std::uint32_t stride = stride_of(level);
        EXPECT_EQ(stride, 4U >> static_cast<unsigned>(level));
        for (std::uint32_t bit = 0; bit < 64; ++bit)
            EXPECT_EQ((lattice_mask(level) >> bit & 1U) != 0,
                      bit % TILE_EDGE % stride == 0 && bit / TILE_EDGE % stride == 0)
                << "stride " << stride << " bit " << bit;
    }
    static_assert(mask_of({0x80000001U, 0x2U}) == 0x0000000280000001U);
}

TEST(TileMasks, GridsCoverTheImage) {
    for (const TileGrid& grid : test::small_images()) {
        EXPECT_EQ(grid.columns(), (grid.width + 7) / 8) << text_of(grid);
        EXPECT_EQ(grid.rows(), (grid.height + 7) / 8) << text_of(grid);
        EXPECT_EQ(grid.tiles(), grid.columns() * grid.rows()) << text_of(grid);
    }
}

TEST(TileMasks, SamplesOfEverythingThatReconstructionReads) {
    RandomBits random(1);
    for (const TileGrid& grid : test::small_images())
        for (int i = 0; i < 40; ++i) {
            const std::vector<Level> levels = random_levels(grid, random);
            EXPECT_EQ(missing_support(grid, levels, required_masks(grid, levels)), 0U)
                << text_of(grid) << ", levels " << i;
        }
}

TEST(TileMasks, SamplesAroundASingleFinerTile) {
    // Each tile in turn is the only one above coarse: nothing else asks for what it needs.
    for (const TileGrid& grid : test::small_images())
        for (const Level level : {Level::middle, Level::full})
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
                std::vector<Level> levels(grid.tiles(), Level::coarse);
                levels[tile] = level;
                EXPECT_EQ(missing_support(grid, levels, required_masks(grid, levels)), 0U)
                    << text_of(grid) << ", tile " << tile << ", stride " << stride_of(level);
            }
}

/// Whether a table of weights of a tile inside the image is that of the taps.
void expect_taps(const float* table, int points, int stride) {
    constexpr int left = 16;
    constexpr int size = 64;
    for (int x = 0; x < TILE_EDGE; ++x) {
        const native::LatticeTaps taps = native::lattice_taps(left + x, stride, size);
        for (int i = 0; i < points; ++i) {
            const int tap = left / stride - 1 + i - taps.first;
            const bool is_tap = tap >= 0 && tap < static_cast<int>(LATTICE_TAPS);
            EXPECT_NEAR(table[TILE_EDGE * i + x], is_tap ? taps.weight[tap] : 0.0F, 1e-7F)
                << "stride " << stride << " pixel " << x << " point " << i;
        }
    }
}

TEST(TileMasks, WeightsOfTilesAreThoseOfTheTaps) {
    expect_taps(native::tile_weights_4, TILE_POINTS_4, 4);
    expect_taps(native::tile_weights_2, TILE_POINTS_2, 2);
}

TEST(TileMasks, MissingSamplesAreNoticed) {
    // The same search finds every pixel that is taken out of the masks of an image of one tile.
    const TileGrid grid{8, 8};
    const std::vector<Level> levels{Level::middle};
    std::vector<TileMask> masks = required_masks(grid, levels);
    ASSERT_EQ(missing_support(grid, levels, masks), 0U);
    for (TileMask rest = masks[0]; rest != 0; rest &= rest - 1) {
        const std::vector<TileMask> fewer{masks[0] & ~(rest & (~rest + 1))};
        EXPECT_GT(missing_support(grid, levels, fewer), 0U) << std::countr_zero(rest);
    }
}

TEST(TileMasks, NothingButLatticesNearFinerTiles) {
    // Far from finer tiles the coarse lattice is all there is, and beside one at middle level no
    // pixel off its lattice is sampled.
    const TileGrid grid{72, 72};
    for (const Level level : {Level::middle, Level::full}) {
        std::vector<Level> levels(grid.tiles(), Level::coarse);
        levels[4 * grid.columns() + 4] = level;
        const std::vector<TileMask> masks = required_masks(grid, levels);
        const std::uint32_t reach = level == Level::middle ? 4 : 1;
        for (std::uint32_t y = 0; y < grid.height; ++y)
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const bool on_coarse = x % 4 == 0 && y % 4 == 0;
                const bool on_own = x % stride_of(level) == 0 && y % stride_of(level) == 0;
                const bool near =
                    x + reach >= 32 && x < 40 + reach && y + reach >= 32 && y < 40 + reach;
                if (on_coarse) {
                    EXPECT_TRUE(in_mask(grid, masks, x, y)) << x << ' ' << y;
                } else if (!on_own || !near) {
                    EXPECT_FALSE(in_mask(grid, masks, x, y)) << x << ' ' << y;
                }
            }
    }
}

TEST(TileMasks, RaisingACoarseTileOnlyAddsPixels) {
    RandomBits random(2);
    for (const TileGrid& grid : test::small_images())
        for (int i = 0; i < 20; ++i) {
            std::vector<Level> levels = random_levels(grid, random);
            const std::uint32_t raised = random.below(grid.tiles());
            levels[raised] = Level::coarse;
            const std::vector<TileMask> before = required_masks(grid, levels);
            for (const Level level : {Level::middle, Level::full}) {
                levels[raised] = level;
                const std::vector<TileMask> after = required_masks(grid, levels);
                EXPECT_EQ(after[raised] & lattice_mask(level), lattice_mask(level));
                for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
                    EXPECT_EQ(before[tile] & ~after[tile], 0U)
                        << text_of(grid) << ", tile " << tile;
            }
        }
}

TEST(TileMasks, FullLevelIsEveryPixel) {
    for (const TileGrid& grid : test::small_images())
        for (const TileMask mask :
             required_masks(grid, std::vector<Level>(grid.tiles(), Level::full)))
            EXPECT_EQ(mask, ~TileMask{0}) << text_of(grid);
}

TEST(TileMasks, DilationIsThatOfSinglePixels) {
    RandomBits random(3);
    for (const TileGrid& grid : test::small_images())
        for (int i = 0; i < 12; ++i) {
            // From single pixels to dense masks; bits beyond the image are bits like any other.
            std::vector<TileMask> masks(grid.tiles(), 0);
            for (TileMask& mask : masks)
                for (int n = 0; n < 2 * i && random.below(3) != 0; ++n)
                    mask |= TileMask{1} << random.below(64);
            masks[random.below(grid.tiles())] |= TileMask{1} << random.below(64);
            EXPECT_EQ(dilated(grid, masks), test::dilated_by_pixels(grid, masks)) << text_of(grid);
        }
}

TEST(TileMasks, DilationOfEveryPixel) {
    const TileGrid grid{24, 24};
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
        for (std::uint32_t bit = 0; bit < 64; ++bit) {
            std::vector<TileMask> masks(grid.tiles(), 0);
            masks[tile] = TileMask{1} << bit;
            EXPECT_EQ(dilated(grid, masks), test::dilated_by_pixels(grid, masks))
                << "tile " << tile << " bit " << bit;
        }
}

TEST(TileMasks, FootprintsAreThoseOfTheDiscontinuityBuffer) {
    RandomBits random(4);
    for (const TileGrid& grid : test::small_images())
        for (int i = 0; i < 12; ++i) {
            // One pixel in the first rounds, and no pixel outside of the image.
            std::vector<TileMask> masks(grid.tiles(), 0);
            std::vector<TileMask> expected(grid.tiles(), 0);
            for (int n = 0; n <= i; ++n) {
                const std::uint32_t x = random.below(grid.width);
                const std::uint32_t y = random.below(grid.height);
                masks[y / TILE_EDGE * grid.columns() + x / TILE_EDGE] |=
                    TileMask{1} << (y % TILE_EDGE * TILE_EDGE + x % TILE_EDGE);
                test::for_support(grid, x, y, 1, [&](std::uint32_t u, std::uint32_t v) {
                    expected[v / TILE_EDGE * grid.columns() + u / TILE_EDGE] |=
                        TileMask{1} << (v % TILE_EDGE * TILE_EDGE + u % TILE_EDGE);
                });
            }
            const std::vector<TileMask> found = footprint_masks(grid, masks);
            for (std::uint32_t y = 0; y < grid.height; ++y)
                for (std::uint32_t x = 0; x < grid.width; ++x)
                    if (in_mask(grid, expected, x, y)) {
                        ASSERT_TRUE(in_mask(grid, found, x, y)) << text_of(grid);
                    }
        }
}

}  // namespace
}  // namespace weft::tile_masks_test
