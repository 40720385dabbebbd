// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "adaptive/level_hysteresis.h"
#include "adaptive/level_scheduler.h"
#include "tests/testing/made_up_frames.h"

// The scheduler with levels that earlier images hold, and the verdicts that it gives to them.
namespace weft::held_levels_test {
namespace {

using test::Frame;
using test::MadeUpImage;
using test::plain;
using test::random_image;
using test::random_signal;
using test::RandomBits;
using test::run_frame;
using test::Signal;

std::vector<Level> random_levels(const TileGrid& grid, RandomBits& random) {
    std::vector<Level> levels;
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
        levels.push_back(static_cast<Level>(random.below(3)));
    return levels;
}

TEST(HeldLevels, NothingHeldChangesNothing) {
    RandomBits random(1);
    for (const TileGrid& grid : test::small_images()) {
        const MadeUpImage image = random_image(grid, random);
        const Signal signal = random_signal(random);
        const std::vector<Level> nothing(grid.tiles(), Level::coarse);
        const Frame free = run_frame(image, 1.0, signal);
        const Frame held = run_frame(image, 1.0, signal, false, {}, nothing);
        for (std::size_t round = 0; round < free.rounds.size(); ++round)
            EXPECT_EQ(free.rounds[round].pixels, held.rounds[round].pixels);
    }
}

TEST(HeldLevels, AreLeastLevelsThatDoNotSpeakForThemselves) {
    // With all signals at hand a tile is judged as without a memory.
    RandomBits random(2);
    for (const TileGrid& grid : test::small_images())
        for (const double threshold : {0.03, 0.3, 3.0}) {
            const MadeUpImage image = random_image(grid, random);
            const Signal signal = random_signal(random);
            const std::vector<Level> memory = random_levels(grid, random);
            const std::vector<Level> least = random_levels(grid, random);
            const Frame free = run_frame(image, threshold, signal, true, least);
            const Frame held = run_frame(image, threshold, signal, true, least, memory);
            EXPECT_EQ(held.verdict.asked, free.verdict.asked);
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
                ASSERT_EQ(held.levels[tile], std::max(free.levels[tile], memory[tile])) << tile;
        }
}

TEST(HeldLevels, VerdictsAreThoseOfTwoThresholds) {
    RandomBits random(3);
    std::size_t between = 0;
    for (const TileGrid& grid : test::small_images())
        for (const double threshold : {0.03, 0.3, 3.0}) {
            const MadeUpImage image = random_image(grid, random);
            const Signal signal = random_signal(random);
            const std::vector<Level> all(grid.tiles(), Level::full);
            const Frame frame = run_frame(image, threshold, signal, true, {}, all);
            const Frame lower = run_frame(image, release_share * threshold, signal, true);
            EXPECT_EQ(frame.verdict.kept, lower.verdict.asked);
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
                ASSERT_LE(frame.verdict.asked[tile], frame.verdict.kept[tile]);
                between += frame.verdict.asked[tile] < frame.verdict.kept[tile] ? 1U : 0U;
            }
        }
    EXPECT_GT(between, 10U) << "no error was between the thresholds";
}

TEST(HeldLevels, WhatOnlyGeometryOrShadowsAskForIsNoVerdict) {
    // Even light: nothing errs, whatever level the tiles are sampled at.
    RandomBits random(4);
    for (const TileGrid& grid : test::small_images()) {
        const MadeUpImage image = random_image(grid, random);
        const Frame frame = run_frame(
            image, 0.5, [](auto, auto) { return 1.0F; }, false, random_levels(grid, random),
            random_levels(grid, random));
        for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
            EXPECT_EQ(frame.verdict.asked[tile], Level::coarse);
            EXPECT_EQ(frame.verdict.kept[tile], Level::coarse);
        }
    }
}

TEST(HeldLevels, WhatIsNotFiniteAsksForFull) {
    const TileGrid grid{24, 24};
    const Frame frame = run_frame(plain(grid), 1.0, [](auto x, auto y) {
        return x == 12 && y == 12 ? std::numeric_limits<float>::quiet_NaN() : 1.0F;
    });
    EXPECT_EQ(frame.verdict.asked[4], Level::full);
    EXPECT_EQ(frame.verdict.kept[4], Level::full);
}

TEST(HeldLevels, AStillImageKeepsItsRounds) {
    // Signals only where there are samples: what is held must not let others be judged otherwise.
    RandomBits random(5);
    for (const TileGrid& grid : test::small_images()) {
        const MadeUpImage image = random_image(grid, random);
        const Signal signal = random_signal(random);
        const Frame first = run_frame(image, 0.3, signal);
        LevelHysteresis memory(grid.tiles());
        memory.add(first.verdict);
        for (int i = 0; i < 8; ++i) {
            memory.begin_image();
            const Frame frame = run_frame(image, 0.3, signal, false, {}, memory.held());
            memory.add(frame.verdict);
            ASSERT_EQ(frame.levels, first.levels) << i;
            for (std::size_t round = 0; round < first.rounds.size(); ++round)
                ASSERT_EQ(frame.rounds[round].pixels, first.rounds[round].pixels) << i;
        }
    }
}

}  // namespace
}  // namespace weft::held_levels_test
