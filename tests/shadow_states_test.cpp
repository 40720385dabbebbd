// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "schedule/shadow_states.h"

#include <gtest/gtest.h>

#include <string>

#include "picture_masks.h"

// What is done about a group of lights follows from three bits of a tile; the table below is
// written out by hand.
namespace weft {
namespace {

using test::Uniform;

enum class Act : std::uint8_t { dark, open, trace };

Act act_of(const ShadowState& state, std::uint32_t group) {
    const bool trace = (state.trace >> group & 1U) != 0;
    const bool open = (state.open >> group & 1U) != 0;
    EXPECT_FALSE(trace && open);
    return trace ? Act::trace : open ? Act::open : Act::dark;
}

struct Row {
    std::uint32_t seen, hidden, open;
    Act act;
};

// A tile alone. `open` without `seen` is of no use: nothing was seen that could be open.
constexpr Row alone[] = {{0, 0, 0, Act::dark},  {0, 0, 1, Act::dark},  {0, 1, 0, Act::dark},
                         {0, 1, 1, Act::dark},  {1, 0, 0, Act::trace}, {1, 0, 1, Act::open},
                         {1, 1, 0, Act::trace}, {1, 1, 1, Act::trace}};

shared::TileShadows shadows(std::uint32_t seen, std::uint32_t hidden, std::uint32_t open) {
    return {seen, hidden, open, 0};
}

TEST(ShadowStates, TruthTableOfATileAlone) {
    for (const std::uint32_t groups : {1U, 2U, 16U})
        for (std::uint32_t group = 0; group < groups; ++group)
            for (const Row& row : alone) {
                const std::vector<shared::TileShadows> tiles{
                    shadows(row.seen << group, row.hidden << group, row.open << group)};
                const std::vector<ShadowState> states = shadow_states(tiles, groups);
                ASSERT_EQ(states.size(), 1U);
                EXPECT_EQ(states[0].penumbra, (row.seen & row.hidden) << group);
                for (std::uint32_t other = 0; other < SHADOW_GROUPS; ++other)
                    EXPECT_EQ(act_of(states[0], other), other == group ? row.act : Act::dark)
                        << row.seen << row.hidden << row.open << " group " << group << " of "
                        << groups;
            }
}

TEST(ShadowStates, WhereASampleSawAllOrNothingItIsNoPenumbra) {
    const std::vector<shared::TileShadows> tiles{{3, 3, 0, 2}};
    EXPECT_EQ(shadow_states(tiles, 2), (std::vector<ShadowState>{{3, 0, 1}}));
}

TEST(ShadowStates, GroupsThatDoNotExistAreLeftAlone) {
    const std::vector<shared::TileShadows> tiles{shadows(~0U, 0, 0), shadows(~0U, 0, ~0U),
                                                 shadows(~0U, ~0U, ~0U)};
    const std::vector<ShadowState> states = shadow_states(tiles, 3);
    EXPECT_EQ(states, (std::vector<ShadowState>{{7, 0, 0}, {0, 7, 0}, {7, 0, 7}}));
}

TEST(ShadowStates, GroupsAndTilesDoNotMix) {
    Uniform random(1);
    std::vector<shared::TileShadows> tiles(200);
    for (auto& tile : tiles)
        tile = shadows(random.below(1U << 16) | random.below(1U << 16), random.below(1U << 16),
                       random.below(1U << 16));
    const std::vector<ShadowState> all = shadow_states(tiles, SHADOW_GROUPS);
    ASSERT_EQ(all.size(), tiles.size());
    for (std::size_t i = 0; i < tiles.size(); ++i)
        for (std::uint32_t group = 0; group < SHADOW_GROUPS; ++group) {
            const std::vector<shared::TileShadows> single{shadows(tiles[i].seen >> group & 1U,
                                                                  tiles[i].hidden >> group & 1U,
                                                                  tiles[i].open >> group & 1U)};
            EXPECT_EQ(act_of(all[i], group), act_of(shadow_states(single, 1)[0], 0));
        }
}

TEST(ShadowStates, WhatNoSampleMetWantsFullLevel) {
    for (const std::uint32_t groups : {1U, 2U, 16U}) {
        const auto all = static_cast<std::uint16_t>((1U << groups) - 1U);
        EXPECT_EQ(traced_state(groups), (ShadowState{all, 0, 0}));
        for (std::uint32_t group = 0; group < groups; ++group) {
            const auto bit = static_cast<std::uint16_t>(1U << group);
            const auto others = static_cast<std::uint16_t>(all & ~bit);
            // Seen by all beside open ones, beside penumbrae; a penumbra; nothing to trace.
            EXPECT_EQ(shadow_levels(std::vector<ShadowState>{{bit, others, 0},
                                                             {all, 0, others},
                                                             {bit, others, bit},
                                                             {0, all, 0},
                                                             {0, 0, 0}}),
                      (std::vector<Level>{Level::full, Level::full, Level::middle, Level::coarse,
                                          Level::coarse}));
        }
    }
}

TEST(ShadowStates, NoMoreGroupsThanLightsAndBits) {
    EXPECT_EQ(shadow_groups(1), 1U);
    EXPECT_EQ(shadow_groups(2), 2U);
    EXPECT_EQ(shadow_groups(SHADOW_GROUPS), SHADOW_GROUPS);
    EXPECT_EQ(shadow_groups(SHADOW_GROUPS + 1), SHADOW_GROUPS);
    EXPECT_EQ(shadow_groups(100000), SHADOW_GROUPS);
}

/// The word of one block: what all its pixels' tiles agree on, and rays for the rest.
std::uint32_t word_of(const TileGrid& grid, const WorkList& list, std::size_t block,
                      const std::vector<ShadowState>& states, std::uint32_t groups) {
    std::uint32_t word = 0;
    for (std::uint32_t group = 0; group < groups; ++group) {
        bool all_open = true;
        bool all_dark = true;
        for (std::size_t i = 0; i < PACKET_BLOCK; ++i) {
            const std::uint32_t pixel = list.pixels[block * PACKET_BLOCK + i];
            if (pixel == NO_TRIANGLE) continue;
            const Act act = act_of(states[pixel / grid.width / TILE_EDGE * grid.columns() +
                                          pixel % grid.width / TILE_EDGE],
                                   group);
            all_open = all_open && act == Act::open;
            all_dark = all_dark && act == Act::dark;
        }
        if (all_open) word |= 1U << (16 + group);
        if (!all_open && !all_dark) word |= 1U << group;
    }
    return word;
}

TEST(ShadowStates, BlocksDoWhatTheirTilesAgreeOn) {
    Uniform random(2);
    for (const TileGrid& grid : test::small_pictures())
        for (const std::uint32_t groups : {1U, 2U, 16U}) {
            SCOPED_TRACE(std::to_string(grid.width) + "x" + std::to_string(grid.height) + ", " +
                         std::to_string(groups) + " groups");
            std::vector<ShadowState> states(grid.tiles());
            std::vector<TileMask> masks(grid.tiles());
            const ShadowState common{0, static_cast<std::uint16_t>(random.below(1U << groups)), 0};
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
                const std::uint32_t trace = random.below(1U << groups);
                const std::uint32_t open = random.below(1U << groups) & ~trace;
                // Mostly alike, so that there are blocks that agree.
                states[tile] = random.below(4) != 0
                                   ? common
                                   : ShadowState{static_cast<std::uint16_t>(trace),
                                                 static_cast<std::uint16_t>(open), 0};
                masks[tile] = random.mask() & random.mask();
            }
            const WorkList list = make_work_list(grid, masks, 3);
            const std::vector<std::uint32_t> words = block_shadows(grid, list, states, groups);
            ASSERT_EQ(words.size(), list.block_sets.size());
            for (std::size_t block = 0; block < words.size(); ++block)
                EXPECT_EQ(words[block], word_of(grid, list, block, states, groups))
                    << "block " << block;
        }
}

}  // namespace
}  // namespace weft
