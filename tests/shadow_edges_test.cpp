// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "schedule/shadow_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "device/shared_types.h"

// Which blocks of the work list are sampled again, against a search of every pixel.
namespace weft {
namespace {

std::vector<std::uint32_t> random_edges(std::size_t pixels, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> edges(pixels);
    for (std::uint32_t& edge : edges) edge = random() % 29 == 0 ? 1U << random() % 16 : 0U;
    return edges;
}

TEST(ShadowEdges, EveryPixelIsInTheBlockThatHoldsIt) {
    const WorkList work = make_work_list(37, 21, 3, 16);
    const std::vector<std::uint32_t> blocks = pixel_blocks(work, 37 * 21);
    for (std::size_t slot = 0; slot < work.pixels.size(); ++slot) {
        if (work.pixels[slot] == NO_TRIANGLE) continue;
        EXPECT_EQ(blocks[work.pixels[slot]], slot / PACKET_BLOCK);
    }
}

TEST(ShadowEdges, FindsTheBlocksOfEveryEdgeAndNoOthers) {
    for (const auto& [width, height] :
         {std::pair{1U, 1U}, {7U, 3U}, {8U, 8U}, {37U, 21U}, {64U, 9U}}) {
        const TileGrid grid{width, height};
        const WorkList work = make_work_list(width, height, 3, 32);
        const std::vector<std::uint32_t> edges = random_edges(std::size_t{width} * height, width);
        const ShadowEdges found =
            find_shadow_edges(grid, edges, pixel_blocks(work, edges.size()),
                              static_cast<std::uint32_t>(work.pixels.size() / PACKET_BLOCK));
        std::set<std::uint32_t> blocks;
        std::vector<Level> levels(grid.tiles(), Level::coarse);
        for (std::size_t slot = 0; slot < work.pixels.size(); ++slot) {
            const std::uint32_t pixel = work.pixels[slot];
            if (pixel == NO_TRIANGLE || edges[pixel] == 0) continue;
            blocks.insert(static_cast<std::uint32_t>(slot / PACKET_BLOCK));
            levels[pixel / width / TILE_EDGE * grid.columns() + pixel % width / TILE_EDGE] =
                Level::full;
        }
        EXPECT_EQ(found.blocks, std::vector<std::uint32_t>(blocks.begin(), blocks.end()));
        EXPECT_EQ(found.levels, levels);
        EXPECT_EQ(found.pixels, static_cast<std::uint64_t>(
                                    std::ranges::count_if(edges, [](auto e) { return e != 0; })));
    }
}

TEST(ShadowEdges, NothingToSampleAgainWhereAllSawTheSame) {
    const TileGrid grid{40, 24};
    const WorkList work = make_work_list(40, 24, 3, 64);
    const std::vector<std::uint32_t> edges(std::size_t{40} * 24, 0);
    const ShadowEdges found =
        find_shadow_edges(grid, edges, pixel_blocks(work, edges.size()),
                          static_cast<std::uint32_t>(work.pixels.size() / PACKET_BLOCK));
    EXPECT_TRUE(found.blocks.empty());
    EXPECT_EQ(found.pixels, 0U);
}

}  // namespace
}  // namespace weft
