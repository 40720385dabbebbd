// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/cache_picks.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "tests/testing/image_masks.h"

namespace weft::cache_picks_test {
namespace {

/// Random masks with about a `share` of bits set, also of pixels beyond the image.
std::vector<TileMask> random_masks(const TileGrid& grid, std::uint32_t seed, int sparseness) {
    test::RandomBits random(seed);
    std::vector<TileMask> masks(grid.tiles());
    for (TileMask& mask : masks) {
        mask = ~TileMask{0};
        for (int i = 0; i < sparseness; ++i) mask &= random.mask();
    }
    return masks;
}

/// Square of the distance from the centre of the pixel's square, in half pixels.
std::uint32_t from_centre(const TileGrid& grid, std::uint32_t pixel, std::uint32_t edge) {
    const auto square = [edge](std::uint32_t at) {
        const int twice = 2 * static_cast<int>(at % edge) + 1 - static_cast<int>(edge);
        return static_cast<std::uint32_t>(twice * twice);
    };
    return square(pixel % grid.width) + square(pixel / grid.width);
}

TEST(CachePicks, AreTheMiddlemostMissingPixelsOfEverySquare) {
    for (const TileGrid& grid : test::small_images())
        for (const std::uint32_t edge : cache_rounds)
            for (const int sparseness : {0, 1, 4, 9}) {
                const std::vector<TileMask> masks =
                    random_masks(grid, 7 * edge + grid.width, sparseness);
                // Brute force: every missing pixel by square, the best so far kept.
                std::map<std::uint32_t, std::uint32_t> best;
                const std::uint32_t columns = (grid.width + edge - 1) / edge;
                for (std::uint32_t y = 0; y < grid.height; ++y)
                    for (std::uint32_t x = 0; x < grid.width; ++x) {
                        if (!test::in_mask(grid, masks, x, y)) continue;
                        const std::uint32_t pixel = y * grid.width + x;
                        const std::uint32_t square = y / edge * columns + x / edge;
                        const auto [at, is_new] = best.try_emplace(square, pixel);
                        if (!is_new &&
                            from_centre(grid, pixel, edge) < from_centre(grid, at->second, edge))
                            at->second = pixel;
                    }
                std::vector<std::uint32_t> expected;
                for (const auto& [square, pixel] : best) expected.push_back(pixel);
                EXPECT_EQ(pick_missing(grid, masks, edge), expected)
                    << grid.width << "x" << grid.height << " edge " << edge;
            }
}

TEST(CachePicks, TheLastRoundTakesAllThatIsMissing) {
    EXPECT_EQ(cache_rounds[std::size(cache_rounds) - 1], 1U);
    const TileGrid grid{23, 40};
    const std::vector<TileMask> all(grid.tiles(), ~TileMask{0});
    EXPECT_EQ(pick_missing(grid, all, 1).size(), 23U * 40U);
    EXPECT_TRUE(pick_missing(grid, std::vector<TileMask>(grid.tiles(), 0), 1).empty());
}

}  // namespace
}  // namespace weft::cache_picks_test
