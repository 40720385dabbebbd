// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/work_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "tests/testing/image_masks.h"

namespace weft::work_order_test {
namespace {

constexpr float extent = 2.0F;

/// Pixels of each set, in the order of the list; checks that blocks are whole and pure.
std::map<std::uint32_t, std::vector<std::uint32_t>> by_set(const WorkList& list) {
    EXPECT_EQ(list.pixels.size(), list.block_sets.size() * PACKET_BLOCK);
    std::map<std::uint32_t, std::vector<std::uint32_t>> sets;
    for (std::size_t i = 0; i < list.pixels.size(); ++i)
        if (list.pixels[i] != INVALID_INDEX)
            sets[list.block_sets[i / PACKET_BLOCK]].push_back(list.pixels[i]);
    return sets;
}

std::vector<shared::float4> random_places(std::size_t count) {
    test::RandomBits random(3);
    const auto coordinate = [&] {
        return extent * (static_cast<float>(random.below(4097)) / 2048.0F - 1.0F);
    };
    std::vector<shared::float4> places(count);
    for (shared::float4& place : places) place = {coordinate(), coordinate(), coordinate(), 0.0F};
    return places;
}

TEST(WorkOrder, KeepsEveryPixelInItsSetAndSortsByPlace) {
    const TileGrid grid{61, 43};
    const std::vector<TileMask> masks(grid.tiles(), 0x5A3C0FF0965A11E7ULL);
    const std::vector<shared::float4> places = random_places(61 * 43);
    const WorkList list = make_work_list(grid, masks, 3);
    const WorkList ordered = ordered_by_place(list, places, extent);
    auto before = by_set(list);
    auto after = by_set(ordered);
    ASSERT_EQ(before.size(), 9U);
    ASSERT_EQ(after.size(), 9U);
    for (auto& [set, pixels] : after) {
        EXPECT_TRUE(std::is_sorted(pixels.begin(), pixels.end(), [&](auto a, auto b) {
            return morton_code(places[a], extent) < morton_code(places[b], extent);
        }));
        std::sort(pixels.begin(), pixels.end());
        std::sort(before[set].begin(), before[set].end());
        EXPECT_EQ(pixels, before[set]);
    }
    EXPECT_EQ(ordered_by_place(list, places, extent).pixels, ordered.pixels);
}

TEST(WorkOrder, EqualPlacesKeepTheirOrder) {
    const TileGrid grid{64, 64};
    const std::vector<TileMask> masks(grid.tiles(), ~TileMask{0});
    const WorkList list = make_work_list(grid, masks, 3);
    const std::vector<shared::float4> places(64 * 64);
    EXPECT_EQ(by_set(ordered_by_place(list, places, extent)), by_set(list));
    EXPECT_TRUE(ordered_by_place({}, places, extent).pixels.empty());
}

TEST(WorkOrder, CodesInterleaveTheBitsOfTheCells) {
    for (const std::uint32_t x : {0U, 1U, 5U, 64U, 127U})
        for (const std::uint32_t y : {0U, 2U, 127U})
            for (const std::uint32_t z : {0U, 99U, 127U}) {
                const auto centre = [](std::uint32_t cell) {
                    return extent * ((static_cast<float>(cell) + 0.5F) / 64.0F - 1.0F);
                };
                std::uint32_t expected = 0;
                for (unsigned bit = 0; bit < 7; ++bit)
                    expected |= (x >> bit & 1U) << (3 * bit) | (y >> bit & 1U) << (3 * bit + 1) |
                                (z >> bit & 1U) << (3 * bit + 2);
                EXPECT_EQ(morton_code({centre(x), centre(y), centre(z), 0.0F}, extent), expected);
            }
}

TEST(WorkOrder, PlacesOutsideAndNoNumbersHaveACell) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(morton_code({-9.0F, -infinity, std::nanf(""), 0.0F}, extent), 0U);
    EXPECT_EQ(morton_code({9.0F, infinity, extent, 0.0F}, extent), (1U << 21) - 1U);
}

}  // namespace
}  // namespace weft::work_order_test
