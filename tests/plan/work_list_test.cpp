// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/work_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/testing/image_masks.h"

namespace weft::work_list_test {
namespace {

struct Shape {
    std::uint32_t width, height, interleave, tile;
};

std::string text_of(const Shape& shape) {
    return std::to_string(shape.width) + "x" + std::to_string(shape.height) + ", n " +
           std::to_string(shape.interleave) + ", tile " + std::to_string(shape.tile);
}

WorkList list_of(const Shape& shape) {
    return make_work_list(shape.width, shape.height, shape.interleave, shape.tile);
}

/// What is wrong with a list as such, or empty.
std::string fault_of(const Shape& shape, const WorkList& list) {
    if (list.pixels.size() % PACKET_BLOCK != 0) return "is not a whole number of blocks";
    if (list.block_sets.size() * PACKET_BLOCK != list.pixels.size())
        return "has another number of sets than blocks";
    std::vector<int> seen(std::size_t{shape.width} * shape.height, 0);
    for (std::size_t slot = 0; slot < list.pixels.size(); ++slot) {
        const std::uint32_t pixel = list.pixels[slot];
        if (pixel == INVALID_INDEX) continue;
        if (pixel >= seen.size()) return "holds a pixel outside the image";
        ++seen[pixel];
        const std::uint32_t n = shape.interleave;
        const std::uint32_t set = pixel % shape.width % n + n * (pixel / shape.width % n);
        if (list.block_sets[slot / PACKET_BLOCK] != set)
            return "puts pixel " + std::to_string(pixel) + " into another set's block";
    }
    const auto wrong = std::find_if(seen.begin(), seen.end(), [](int count) { return count != 1; });
    if (wrong == seen.end()) return "";
    return "holds pixel " + std::to_string(wrong - seen.begin()) + " " + std::to_string(*wrong) +
           " times";
}

TEST(WorkList, EveryPixelOnceInItsSet) {
    for (const std::uint32_t n : {1U, 2U, 3U, 5U, 8U})
        for (const std::uint32_t tile : {1U, 2U, 7U, 16U, 64U, 100U, 4096U})
            for (const auto& [width, height] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
                     {1, 1}, {1, 37}, {53, 1}, {2, 3}, {16, 16}, {64, 64}, {65, 63}, {97, 130}}) {
                const Shape shape{width, height, n, tile};
                EXPECT_EQ(fault_of(shape, list_of(shape)), "") << text_of(shape);
            }
}

TEST(WorkList, EveryPixelOnceForRandomShapes) {
    std::mt19937 random(1);
    const auto up_to = [&](std::uint32_t most) {
        return std::uniform_int_distribution<std::uint32_t>(1, most)(random);
    };
    for (int i = 0; i < 300; ++i) {
        const Shape shape{up_to(90), up_to(90), up_to(9), up_to(120)};
        EXPECT_EQ(fault_of(shape, list_of(shape)), "") << text_of(shape);
    }
}

TEST(WorkList, FaultsAreNoticed) {
    const Shape shape{20, 20, 3, 16};
    const WorkList good = list_of(shape);
    ASSERT_EQ(fault_of(shape, good), "");
    WorkList twice = good;
    twice.pixels[1] = twice.pixels[0];
    EXPECT_NE(fault_of(shape, twice), "");
    WorkList moved = good;
    moved.block_sets[0] ^= 1U;
    EXPECT_NE(fault_of(shape, moved), "");
    WorkList outside = good;
    outside.pixels[0] = 400;
    EXPECT_NE(fault_of(shape, outside), "");
}

TEST(WorkList, PaddingOnlyEndsTheSlotsOfASetInATile) {
    const Shape shape{50, 41, 3, 20};
    const WorkList list = list_of(shape);
    for (std::size_t slot = 0; slot + 1 < list.pixels.size(); ++slot)
        if (list.pixels[slot] == INVALID_INDEX && (slot + 1) % PACKET_BLOCK != 0) {
            EXPECT_EQ(list.pixels[slot + 1], INVALID_INDEX) << "slot " << slot;
        }
    // A block of padding alone would be work for nothing.
    for (std::size_t block = 0; block < list.block_sets.size(); ++block)
        EXPECT_NE(list.pixels[block * PACKET_BLOCK], INVALID_INDEX) << "block " << block;
}

TEST(WorkList, WholeTilesNeedNoPadding) {
    const WorkList list = make_work_list(128, 64, 1, 64);
    EXPECT_EQ(list.pixels.size(), 128u * 64u);
    EXPECT_EQ(std::count(list.pixels.begin(), list.pixels.end(), INVALID_INDEX), 0);
}

TEST(WorkList, BlocksOfWholeTilesAreCompact) {
    // Along a Morton curve 16 pixels of one set are a 4x4 square of that set.
    for (const std::uint32_t n : {1U, 2U, 3U}) {
        const std::uint32_t edge = 32 * n;
        const WorkList list = make_work_list(edge, edge, n, edge);
        for (std::size_t block = 0; block < list.block_sets.size(); ++block) {
            std::array<std::uint32_t, 4> box{edge, 0, edge, 0};
            for (std::size_t i = 0; i < PACKET_BLOCK; ++i) {
                const std::uint32_t pixel = list.pixels[block * PACKET_BLOCK + i];
                ASSERT_NE(pixel, INVALID_INDEX);
                box = {std::min(box[0], pixel % edge), std::max(box[1], pixel % edge),
                       std::min(box[2], pixel / edge), std::max(box[3], pixel / edge)};
            }
            EXPECT_EQ(box[1] - box[0], 3 * n);
            EXPECT_EQ(box[3] - box[2], 3 * n);
        }
    }
}

TEST(WorkList, TilesFollowEachOther) {
    const std::uint32_t tile = 16;
    const std::uint32_t width = 40;
    const WorkList list = make_work_list(width, 40, 3, tile);
    std::vector<std::uint32_t> order;
    for (const std::uint32_t pixel : list.pixels) {
        if (pixel == INVALID_INDEX) continue;
        const std::uint32_t at = pixel / width / tile * 3 + pixel % width / tile;
        if (order.empty() || order.back() != at) order.push_back(at);
    }
    EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(WorkList, LargeTilesAreTheWholeImage) {
    // The order of a tile does not depend on what lies beyond the image.
    const WorkList whole = make_work_list(60, 45, 3, 60);
    EXPECT_EQ(make_work_list(60, 45, 3, 4096).pixels, whole.pixels);
}

std::vector<TileMask> random_masks(const TileGrid& grid, test::RandomBits& random) {
    // Empty, sparse and full tiles, with bits beyond the image.
    std::vector<TileMask> masks(grid.tiles(), 0);
    for (TileMask& mask : masks) {
        const std::uint32_t kind = random.below(4);
        if (kind == 1) mask = TileMask{1} << random.below(64);
        if (kind == 2) mask = random.mask() & random.mask();
        if (kind == 3) mask = ~TileMask{0};
    }
    return masks;
}

/// What is wrong with the list of these masks, or empty.
std::string fault_of(const TileGrid& grid, const std::vector<TileMask>& masks,
                     std::uint32_t interleave, const WorkList& list) {
    if (list.pixels.size() % PACKET_BLOCK != 0) return "is not a whole number of blocks";
    if (list.block_sets.size() * PACKET_BLOCK != list.pixels.size())
        return "has another number of sets than blocks";
    std::vector<int> seen(std::size_t{grid.width} * grid.height, 0);
    std::size_t padding = 0;
    for (std::size_t slot = 0; slot < list.pixels.size(); ++slot) {
        const std::uint32_t pixel = list.pixels[slot];
        if (pixel == INVALID_INDEX) {
            ++padding;
            continue;
        }
        if (pixel >= seen.size()) return "holds a pixel outside the image";
        ++seen[pixel];
        const std::uint32_t set =
            pixel % grid.width % interleave + interleave * (pixel / grid.width % interleave);
        if (list.block_sets[slot / PACKET_BLOCK] != set)
            return "puts pixel " + std::to_string(pixel) + " into another set's block";
    }
    // What buffers are made for.
    if (padding > std::size_t{work_regions(grid)} * interleave * interleave * (PACKET_BLOCK - 1))
        return "has too much padding";
    for (std::uint32_t y = 0; y < grid.height; ++y)
        for (std::uint32_t x = 0; x < grid.width; ++x)
            if (seen[y * grid.width + x] != (test::in_mask(grid, masks, x, y) ? 1 : 0))
                return "holds pixel " + std::to_string(x) + ", " + std::to_string(y) + " " +
                       std::to_string(seen[y * grid.width + x]) + " times";
    return "";
}

std::string text_of(const TileGrid& grid, std::uint32_t interleave) {
    return text_of(Shape{grid.width, grid.height, interleave, TILE_EDGE});
}

TEST(WorkList, MasksGiveTheirPixelsOnceInTheirSets) {
    test::RandomBits random(1);
    for (const TileGrid& grid : test::small_images())
        for (const std::uint32_t n : {1U, 2U, 3U, 5U, 8U, 9U})
            for (int i = 0; i < 4; ++i) {
                const std::vector<TileMask> masks = random_masks(grid, random);
                EXPECT_EQ(fault_of(grid, masks, n, make_work_list(grid, masks, n)), "")
                    << text_of(grid, n);
            }
}

TEST(WorkList, FaultsOfMasksAreNoticed) {
    const TileGrid grid{20, 20};
    const std::vector<TileMask> masks(grid.tiles(), ~TileMask{0});
    const WorkList good = make_work_list(grid, masks, 3);
    ASSERT_EQ(fault_of(grid, masks, 3, good), "");
    WorkList twice = good;
    twice.pixels[1] = twice.pixels[0];
    EXPECT_NE(fault_of(grid, masks, 3, twice), "");
    std::vector<TileMask> fewer = masks;
    fewer[4] &= ~TileMask{2};
    EXPECT_NE(fault_of(grid, masks, 3, make_work_list(grid, fewer, 3)), "");
    WorkList padded = good;
    padded.pixels.resize(padded.pixels.size() + 9 * PACKET_BLOCK, INVALID_INDEX);
    padded.block_sets.resize(padded.pixels.size() / PACKET_BLOCK, 0);
    EXPECT_NE(fault_of(grid, masks, 3, padded), "");
}

TEST(WorkList, MasksWithoutPixelsGiveNothing) {
    for (const TileGrid& grid : test::small_images()) {
        const WorkList list = make_work_list(grid, std::vector<TileMask>(grid.tiles(), 0), 3);
        EXPECT_TRUE(list.pixels.empty() && list.block_sets.empty()) << text_of(grid, 3);
    }
    // The one bit lies below the image.
    EXPECT_TRUE(
        make_work_list(TileGrid{8, 3}, std::vector<TileMask>{TileMask{1} << 24}, 3).pixels.empty());
}

TEST(WorkList, RegionsOfMasksFollowEachOtherAndStandAlone) {
    // What a region's list holds does not depend on the masks of others.
    const TileGrid grid{200, 140};
    ASSERT_EQ(work_regions(grid), 4U);
    test::RandomBits random(2);
    const std::vector<TileMask> masks = random_masks(grid, random);
    WorkList parts;
    for (std::uint32_t region = 0; region < 4; ++region) {
        std::vector<TileMask> part = masks;
        for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
            const std::uint32_t of = tile % grid.columns() / 16 + 2 * (tile / grid.columns() / 16);
            if (of != region) part[tile] = 0;
        }
        const WorkList list = make_work_list(grid, part, 3);
        EXPECT_FALSE(list.pixels.empty());
        parts.pixels.insert(parts.pixels.end(), list.pixels.begin(), list.pixels.end());
        parts.block_sets.insert(parts.block_sets.end(), list.block_sets.begin(),
                                list.block_sets.end());
    }
    const WorkList all = make_work_list(grid, masks, 3);
    EXPECT_EQ(all.pixels, parts.pixels);
    EXPECT_EQ(all.block_sets, parts.block_sets);
}

TEST(WorkList, ASpreadListKeepsSetsAndPartsNeighbours) {
    for (const std::uint32_t n : {1U, 3U}) {
        const WorkList list = make_spread_work_list(41, 29, n, 32);
        std::vector<std::uint32_t> seen(41 * 29, 0);
        for (std::size_t slot = 0; slot < list.pixels.size(); ++slot) {
            const std::uint32_t pixel = list.pixels[slot];
            if (pixel == INVALID_INDEX) continue;
            ++seen[pixel];
            const std::uint32_t x = pixel % 41;
            const std::uint32_t y = pixel / 41;
            EXPECT_EQ(list.block_sets[slot / PACKET_BLOCK], x % n + n * (y % n));
            // All of a block have the same place in squares of twice the interleaving.
            const std::uint32_t first = list.pixels[slot / PACKET_BLOCK * PACKET_BLOCK];
            EXPECT_EQ(x % (2 * n), first % 41 % (2 * n));
            EXPECT_EQ(y % (2 * n), first / 41 % (2 * n));
        }
        for (const std::uint32_t count : seen) EXPECT_EQ(count, 1U);
    }
}

TEST(WorkList, AShuffledListDealsSquaresToBlocksOfAllSets) {
    for (const std::uint32_t n : {1U, 2U, 3U})
        for (const auto& [width, height] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
                 {1, 1}, {5, 90}, {96, 96}, {131, 77}}) {
            const WorkList list = make_shuffled_work_list(width, height, n);
            ASSERT_EQ(list.pixels.size(), list.block_sets.size() * PACKET_BLOCK);
            std::vector<std::uint32_t> seen(std::size_t{width} * height, 0);
            for (std::size_t slot = 0; slot < list.pixels.size(); ++slot) {
                const std::uint32_t pixel = list.pixels[slot];
                if (pixel == INVALID_INDEX) continue;
                ASSERT_LT(pixel, seen.size());
                ++seen[pixel];
                EXPECT_LT(list.block_sets[slot / PACKET_BLOCK], n * n);
                // All of a block lie in one square, and only its end is padded.
                const std::uint32_t first = list.pixels[slot / PACKET_BLOCK * PACKET_BLOCK];
                ASSERT_NE(first, INVALID_INDEX);
                EXPECT_EQ(pixel % width / (4 * n), first % width / (4 * n));
                EXPECT_EQ(pixel / width / (4 * n), first / width / (4 * n));
            }
            for (const std::uint32_t count : seen) EXPECT_EQ(count, 1U);
        }
}

TEST(WorkList, AShuffledListHasNoGridOfSets) {
    // Of pixels that lie 3 apart, as many have the same set as chance gives: one of nine, and of
    // the square's 143 others 15 in a block. Of a regular list all would. 4 standard deviations.
    constexpr std::uint32_t size = 96;
    const WorkList list = make_shuffled_work_list(size, size, 3);
    std::vector<std::uint32_t> set_of(std::size_t{size} * size);
    std::vector<double> pixels_of(9, 0.0);
    for (std::size_t slot = 0; slot < list.pixels.size(); ++slot) {
        set_of[list.pixels[slot]] = list.block_sets[slot / PACKET_BLOCK];
        ++pixels_of[list.block_sets[slot / PACKET_BLOCK]];
    }
    for (const double pixels : pixels_of) EXPECT_EQ(pixels, size * size / 9.0);
    double same = 0.0;
    double all = 0.0;
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x + 3 < size; ++x) {
            same += set_of[y * size + x] == set_of[y * size + x + 3] ? 1.0 : 0.0;
            ++all;
        }
    const double chance = 15.0 / 143.0 * 0.75 + 1.0 / 9.0 * 0.25;
    EXPECT_NEAR(same / all, chance, 4.0 * std::sqrt(chance / all));
}

}  // namespace
}  // namespace weft::work_list_test
