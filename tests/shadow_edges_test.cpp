// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "schedule/shadow_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "device/shared_types.h"

// How densely lights are sampled, against a plain search of every pixel.
namespace weft {
namespace {

constexpr TileGrid pictures[] = {{1, 1}, {7, 3}, {8, 8}, {9, 1}, {1, 17}, {37, 21}, {64, 9}};
constexpr std::uint32_t light_counts[] = {1, 32, 33, 70};

/// What shadow_edges.cl could have written: few edges, some of them in doubt.
std::vector<std::uint32_t> random_words(std::size_t pixels, std::uint32_t lights,
                                        std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> words(SHADOW_PLANES * shared::shadow_words(lights) * pixels, 0);
    for (std::uint32_t light = 0; light < lights; ++light) {
        const std::size_t first = SHADOW_PLANES * (light / SHADOW_WORD_LIGHTS) * pixels;
        const std::uint32_t bit = 1U << light % SHADOW_WORD_LIGHTS;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            // The more lights, the fewer edges of each, so that pixels of all levels are left.
            if (random() % (8 * lights) != 0) continue;
            words[first + SHADOW_EDGE * pixels + pixel] |= bit;
            if (random() % 3 == 0) words[first + SHADOW_DOUBT * pixels + pixel] |= bit;
        }
    }
    return words;
}

/// Whether a plane of any word has anything of a pixel.
bool any_of(const std::vector<std::uint32_t>& words, std::size_t pixels, std::size_t pixel,
            std::size_t plane) {
    for (std::size_t p = 0; p * pixels < words.size(); ++p)
        if (p % SHADOW_PLANES == plane && words[p * pixels + pixel] != 0) return true;
    return false;
}

Level searched(const std::vector<std::uint32_t>& words, std::size_t pixels, std::size_t pixel) {
    if (any_of(words, pixels, pixel, SHADOW_DOUBT)) return Level::full;
    return any_of(words, pixels, pixel, SHADOW_EDGE) ? Level::middle : Level::coarse;
}

TEST(ShadowEdges, LevelOfEveryPixelIsThatOfItsWords) {
    std::size_t of_level[3] = {};
    for (const TileGrid& grid : pictures)
        for (const std::uint32_t lights : light_counts) {
            const std::size_t pixels = std::size_t{grid.width} * grid.height;
            const auto words = random_words(pixels, lights, grid.width + lights);
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
                const Level level = shadow_level(words, pixels, pixel);
                EXPECT_EQ(level, searched(words, pixels, pixel))
                    << pixel << " of " << pixels << ", " << lights << " lights";
                ++of_level[static_cast<std::size_t>(level)];
            }
        }
    for (const std::size_t count : of_level) EXPECT_GT(count, 0U);
}

TEST(ShadowEdges, TilesHaveTheHighestLevelOfTheirPixels) {
    for (const TileGrid& grid : pictures)
        for (const std::uint32_t lights : light_counts) {
            SCOPED_TRACE(testing::Message()
                         << grid.width << " x " << grid.height << ", " << lights << " lights");
            const std::size_t pixels = std::size_t{grid.width} * grid.height;
            const auto words = random_words(pixels, lights, 3 * grid.width + lights);
            std::vector<Level> levels(grid.tiles(), Level::coarse);
            std::uint64_t edges = 0;
            std::uint64_t full = 0;
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
                const std::size_t x = pixel % grid.width;
                const std::size_t y = pixel / grid.width;
                Level& tile = levels[y / TILE_EDGE * grid.columns() + x / TILE_EDGE];
                const Level level = searched(words, pixels, pixel);
                tile = std::max(tile, level);
                edges += level >= Level::middle ? 1 : 0;
                full += level == Level::full ? 1 : 0;
            }
            const ShadowEdges found = find_shadow_edges(grid, words);
            EXPECT_EQ(found.levels, levels);
            EXPECT_EQ(found.edges, edges);
            EXPECT_EQ(found.pixels, full);
        }
}

TEST(ShadowEdges, OneLightOfOnePixelRaisesItsTileOnly) {
    const TileGrid grid{19, 10};
    const std::size_t pixels = std::size_t{19} * 10;
    for (const std::uint32_t light : {0U, 31U, 32U, 63U})
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            std::vector<std::uint32_t> words(SHADOW_PLANES * 2 * pixels, 0);
            const std::size_t first = SHADOW_PLANES * (light / SHADOW_WORD_LIGHTS) * pixels;
            std::vector<Level> levels(grid.tiles(), Level::coarse);
            Level& tile = levels[pixel / 19 / TILE_EDGE * grid.columns() + pixel % 19 / TILE_EDGE];

            words[first + SHADOW_EDGE * pixels + pixel] = 1U << light % SHADOW_WORD_LIGHTS;
            tile = Level::middle;
            ShadowEdges found = find_shadow_edges(grid, words);
            EXPECT_EQ(found.levels, levels) << pixel;
            EXPECT_EQ(found.edges, 1U);
            EXPECT_EQ(found.pixels, 0U);

            words[first + SHADOW_DOUBT * pixels + pixel] = 1U << light % SHADOW_WORD_LIGHTS;
            tile = Level::full;
            found = find_shadow_edges(grid, words);
            EXPECT_EQ(found.levels, levels) << pixel;
            EXPECT_EQ(found.edges, 1U);
            EXPECT_EQ(found.pixels, 1U);
        }
}

TEST(ShadowEdges, NothingToSampleAgainWhereAllSawTheSame) {
    const TileGrid grid{40, 24};
    const std::vector<std::uint32_t> words(SHADOW_PLANES * 2 * std::size_t{40} * 24, 0);
    const ShadowEdges found = find_shadow_edges(grid, words);
    EXPECT_EQ(found.levels, std::vector<Level>(grid.tiles(), Level::coarse));
    EXPECT_EQ(found.edges, 0U);
    EXPECT_EQ(found.pixels, 0U);
}

}  // namespace
}  // namespace weft
