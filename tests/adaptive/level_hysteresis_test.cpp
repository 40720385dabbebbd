// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/level_hysteresis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/testing/image_masks.h"

namespace weft::level_hysteresis_test {
namespace {

using test::RandomBits;

constexpr Level coarse = Level::coarse;
constexpr Level middle = Level::middle;
constexpr Level full = Level::full;

/// An image of one frame and one tile.
struct Said {
    Level asked = coarse;
    Level kept = coarse;
};

Level after(LevelHysteresis& memory, const Said& said) {
    memory.add({{said.asked}, {said.kept}});
    memory.begin_image();
    return memory.held().front();
}

/// Errors about a threshold of 1: one that asks, one that only keeps, one that does neither.
Said said_of(Level level, double error) {
    return {error >= 1.0 ? level : coarse, error >= release_share ? level : coarse};
}

/// What is held after `history`, told from the definition: some image asked for the level, and
/// since then there were no `quiet_images` in a row that did not keep it.
Level held_by_definition(const std::vector<Said>& history) {
    for (const Level level : {full, middle})
        for (std::size_t asker = 0; asker < history.size(); ++asker) {
            if (history[asker].asked < level) continue;
            std::uint32_t row = 0;
            std::uint32_t longest = 0;
            for (std::size_t i = asker + 1; i < history.size(); ++i) {
                row = history[i].kept >= level ? 0 : row + 1;
                longest = std::max(longest, row);
            }
            if (longest < quiet_images) return level;
        }
    return coarse;
}

TEST(LevelHysteresis, HoldsWhatTheDefinitionSays) {
    RandomBits random(1);
    std::uint32_t held_tiles = 0;
    for (std::uint32_t length = 1; length <= 24; ++length)
        for (std::uint32_t run = 0; run < 200; ++run) {
            // Quiet images are common, so that rows of them are of every length.
            const std::uint32_t quiet_share = 1 + random.below(4);
            LevelHysteresis memory(1);
            std::vector<Said> history;
            for (std::uint32_t i = 0; i < length; ++i) {
                Said said;
                if (random.below(quiet_share + 1) == 0) {
                    said.kept = static_cast<Level>(random.below(3));
                    said.asked = std::min(said.kept, static_cast<Level>(random.below(3)));
                }
                history.push_back(said);
                const Level held = after(memory, said);
                ASSERT_EQ(held, held_by_definition(history)) << "image " << i;
                held_tiles += held != coarse ? 1U : 0U;
            }
        }
    EXPECT_GT(held_tiles, 1000U);
}

TEST(LevelHysteresis, IsRaisedAtOnceAndLoweredAfterFourQuietImages) {
    for (const Level level : {middle, full}) {
        LevelHysteresis memory(1);
        EXPECT_EQ(memory.held().front(), coarse);
        EXPECT_EQ(after(memory, said_of(level, 0.99)), coarse) << "no error asked for it";
        EXPECT_EQ(after(memory, said_of(level, 1.0)), level);
        for (std::uint32_t i = 1; i < quiet_images; ++i)
            EXPECT_EQ(after(memory, said_of(level, 0.69)), level) << i;
        EXPECT_EQ(after(memory, said_of(level, 0.69)), coarse);
        EXPECT_EQ(after(memory, said_of(level, 0.99)), coarse) << "what keeps does not raise";
    }
}

TEST(LevelHysteresis, AnErrorThatWaversChangesNothing) {
    // Without a memory the level would change in every image.
    LevelHysteresis memory(1);
    for (std::uint32_t i = 0; i < 40; ++i)
        EXPECT_EQ(after(memory, said_of(full, i % 2 == 0 ? 1.05 : 0.75)), full) << i;
    for (std::uint32_t i = 0; i < 40; ++i)
        EXPECT_EQ(after(memory, said_of(full, i % quiet_images == 0 ? 0.75 : 0.1)), full) << i;
}

TEST(LevelHysteresis, FallsLevelByLevel) {
    LevelHysteresis memory(1);
    after(memory, {full, full});
    std::vector<Level> held;
    for (const Level kept : {coarse, middle, coarse, coarse, coarse, coarse, coarse})
        held.push_back(after(memory, {coarse, kept}));
    EXPECT_EQ(held, (std::vector<Level>{full, full, full, middle, middle, coarse, coarse}));
}

TEST(LevelHysteresis, FramesOfAnImageSpeakTogetherAndSeeTheSame) {
    LevelHysteresis memory(3);
    memory.add({{full, coarse, coarse}, {full, middle, coarse}});
    EXPECT_EQ(memory.held(), (std::vector<Level>{coarse, coarse, coarse})) << "of this image";
    memory.add({{coarse, middle, coarse}, {coarse, middle, full}});
    memory.begin_image();
    const std::vector<Level> held{full, middle, coarse};
    EXPECT_EQ(memory.held(), held);
    for (int frame = 0; frame < 10; ++frame) {
        memory.add({{coarse, coarse, coarse}, {coarse, coarse, coarse}});
        EXPECT_EQ(memory.held(), held);
    }
    memory.begin_image();
    EXPECT_EQ(memory.held(), held) << "one quiet image, however many frames";
}

TEST(LevelHysteresis, AnImageWithoutAFrameSaysNothing) {
    LevelHysteresis memory(1);
    EXPECT_EQ(after(memory, {full, full}), full);
    for (int i = 0; i < 10; ++i) {
        memory.begin_image();
        EXPECT_EQ(memory.held().front(), full);
    }
}

TEST(LevelHysteresis, ASequenceBeginsWithoutMemory) {
    LevelHysteresis memory(2);
    memory.add({{full, middle}, {full, full}});
    memory.begin_image();
    memory.add({{full, middle}, {full, full}});
    memory.begin_sequence();
    EXPECT_EQ(memory.held(), (std::vector<Level>{coarse, coarse}));
    memory.begin_image();
    EXPECT_EQ(memory.held(), (std::vector<Level>{coarse, coarse})) << "a verdict was kept";
}

TEST(LevelHysteresis, TilesAreOnTheirOwn) {
    RandomBits random(2);
    constexpr std::size_t tiles = 37;
    LevelHysteresis together(tiles);
    std::vector<LevelHysteresis> alone(tiles, LevelHysteresis(1));
    for (int image = 0; image < 50; ++image) {
        LevelVerdict verdict;
        for (std::size_t tile = 0; tile < tiles; ++tile) {
            const bool quiet = random.below(3) != 0;
            const Level kept = quiet ? coarse : static_cast<Level>(random.below(3));
            verdict.kept.push_back(kept);
            verdict.asked.push_back(random.below(2) == 0 ? kept : coarse);
            after(alone[tile], {verdict.asked.back(), kept});
        }
        together.add(verdict);
        together.begin_image();
        for (std::size_t tile = 0; tile < tiles; ++tile)
            ASSERT_EQ(together.held()[tile], alone[tile].held().front()) << tile;
    }
}

}  // namespace
}  // namespace weft::level_hysteresis_test
