// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/level_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "tests/testing/made_up_frames.h"

namespace weft::level_scheduler_test {
namespace {

using test::in_mask;
using test::RandomBits;

using test::Frame;
using test::MadeUpImage;
using test::pixels_of;
using test::plain;
using test::random_image;
using test::random_signal;
using test::run_frame;
using test::settings_of;
using test::Signal;
using test::text_of;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr float bad = std::numeric_limits<float>::quiet_NaN();

TEST(LevelScheduler, RoundsHoldEverySampledPixelOnceAndOnlyLitOnes) {
    RandomBits random(1);
    for (const TileGrid& grid : test::small_images())
        for (const double threshold : {0.0, 1e-3, 0.3, 3.0, infinity}) {
            SCOPED_TRACE(text_of(grid) + ", threshold " + std::to_string(threshold));
            const MadeUpImage image = random_image(grid, random);
            const Frame frame = run_frame(image, threshold, random_signal(random));
            std::vector<int> count(std::size_t{grid.width} * grid.height, 0);
            for (const WorkList& list : frame.rounds)
                for (const std::uint32_t pixel : list.pixels)
                    if (pixel != INVALID_INDEX) ++count.at(pixel);
            for (std::uint32_t y = 0; y < grid.height; ++y)
                for (std::uint32_t x = 0; x < grid.width; ++x)
                    ASSERT_EQ(count[std::size_t{y} * grid.width + x],
                              in_mask(grid, frame.sampled, x, y) ? 1 : 0)
                        << x << ' ' << y;
            std::size_t all = 0;
            for (const WorkList& list : frame.rounds) all += pixels_of(list);
            EXPECT_EQ(all, pixels_of(frame.sampled));
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
                EXPECT_EQ(frame.sampled[tile] & ~image.lit[tile], 0U) << "tile " << tile;
        }
}

TEST(LevelScheduler, TheFirstRoundHoldsTheCoarseLatticeAndWhatTheGeometryWants) {
    RandomBits random(2);
    for (const TileGrid& grid : test::small_images()) {
        const MadeUpImage image = random_image(grid, random);
        LevelScheduler scheduler(grid, settings_of(infinity), image.records);
        const WorkList first = scheduler.next_round();
        std::vector<bool> there(std::size_t{grid.width} * grid.height, false);
        for (const std::uint32_t pixel : first.pixels)
            if (pixel != INVALID_INDEX) there[pixel] = true;
        for (std::uint32_t y = 0; y < grid.height; ++y)
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const bool coarse = x % 4 == 0 && y % 4 == 0;
                if (in_mask(grid, image.lit, x, y) && (coarse || in_mask(grid, image.fine, x, y))) {
                    EXPECT_TRUE(there[std::size_t{y} * grid.width + x])
                        << text_of(grid) << ": " << x << ' ' << y;
                }
            }
    }
}

TEST(LevelScheduler, SamplesOfEverythingThatReconstructionReads) {
    // As reconstruct_tiles.cl chooses the stride of a pixel.
    RandomBits random(3);
    for (const TileGrid& grid : test::small_images())
        for (const double threshold : {0.3, 3.0, infinity}) {
            const MadeUpImage image = random_image(grid, random);
            const Frame frame = run_frame(image, threshold, random_signal(random));
            std::size_t missing = 0;
            for (std::uint32_t y = 0; y < grid.height; ++y)
                for (std::uint32_t x = 0; x < grid.width; ++x) {
                    if (!in_mask(grid, image.lit, x, y)) continue;
                    const std::uint32_t tile = y / TILE_EDGE * grid.columns() + x / TILE_EDGE;
                    const std::uint32_t stride =
                        in_mask(grid, image.fine, x, y) ? 1 : stride_of(frame.levels[tile]);
                    if (mask_of(image.records[tile].middle) != 0) {
                        EXPECT_LE(stride, 2U);
                    }
                    test::for_support(grid, x, y, stride, [&](std::uint32_t u, std::uint32_t v) {
                        missing +=
                            in_mask(grid, image.lit, u, v) && !in_mask(grid, frame.sampled, u, v)
                                ? 1
                                : 0;
                    });
                }
            EXPECT_EQ(missing, 0U) << text_of(grid) << ", threshold " << threshold;
        }
}

TEST(LevelScheduler, ThresholdZeroSamplesEveryLitPixelAtOnce) {
    RandomBits random(4);
    for (const TileGrid& grid : test::small_images())
        for (const double threshold : {0.0, -1.0, static_cast<double>(bad)}) {
            const MadeUpImage image = random_image(grid, random);
            LevelScheduler scheduler(grid, settings_of(threshold), image.records);
            EXPECT_EQ(pixels_of(scheduler.next_round()), pixels_of(image.lit)) << text_of(grid);
            for (const Level level : scheduler.levels()) EXPECT_EQ(level, Level::full);
        }
}

TEST(LevelScheduler, CountsItsTilesAndSamples) {
    RandomBits random(8);
    for (const TileGrid& grid : test::small_images()) {
        const MadeUpImage image = random_image(grid, random);
        LevelScheduler scheduler(grid, settings_of(1.0), image.records);
        EXPECT_EQ(scheduler.samples(), 0U);
        const WorkList first = scheduler.next_round();
        EXPECT_EQ(scheduler.samples(), pixels_of(first));
        EXPECT_TRUE(scheduler.next_round().pixels.empty());
        std::vector<Level> least(grid.tiles());
        for (Level& level : least) level = static_cast<Level>(random.below(3));
        scheduler.require(least);
        std::array<std::uint32_t, 3> counts{};
        for (const Level level : scheduler.levels()) ++counts.at(static_cast<std::size_t>(level));
        EXPECT_EQ(scheduler.tiles_by_level(), counts);
        for (const Level level : {Level::coarse, Level::middle, Level::full})
            EXPECT_EQ(scheduler.has(level), counts.at(static_cast<std::size_t>(level)) > 0);
    }
}

TEST(LevelScheduler, LevelsFallWithTheThreshold) {
    RandomBits random(5);
    for (const TileGrid& grid : test::small_images()) {
        const MadeUpImage image = random_image(grid, random);
        const Signal signal = random_signal(random);
        std::vector<Level> before(grid.tiles(), Level::full);
        for (const double threshold : {0.0, 1e-3, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, infinity}) {
            const std::vector<Level> levels = run_frame(image, threshold, signal, true).levels;
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
                EXPECT_LE(levels[tile], before[tile]) << text_of(grid) << ", tile " << tile;
            before = levels;
        }
        for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
            EXPECT_EQ(before[tile],
                      mask_of(image.records[tile].middle) != 0 ? Level::middle : Level::coarse);
    }
}

TEST(LevelScheduler, RequiredLevelsAreLeastLevels) {
    RandomBits random(6);
    const TileGrid grid{61, 43};
    const MadeUpImage image = random_image(grid, random);
    const Signal signal = random_signal(random);
    const Frame free = run_frame(image, 1.0, signal, true);
    std::vector<Level> least;
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
        least.push_back(static_cast<Level>(random.below(3)));
    const Frame bound = run_frame(image, 1.0, signal, true, least);
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
        EXPECT_GE(bound.levels[tile], least[tile]);
        // From middle on it is judged by the finer lattice alone.
        if (least[tile] == Level::coarse) {
            EXPECT_EQ(bound.levels[tile], free.levels[tile]);
        }
    }
}

TEST(LevelScheduler, EqualInputsGiveEqualLists) {
    RandomBits random(7);
    const TileGrid grid{134, 140};
    const MadeUpImage image = random_image(grid, random);
    const Signal signal = random_signal(random);
    const Frame first = run_frame(image, 1.0, signal);
    const Frame second = run_frame(image, 1.0, signal);
    EXPECT_EQ(first.levels, second.levels);
    EXPECT_EQ(first.sampled, second.sampled);
    for (std::size_t i = 0; i < first.rounds.size(); ++i) {
        EXPECT_EQ(first.rounds[i].pixels, second.rounds[i].pixels);
        EXPECT_EQ(first.rounds[i].block_sets, second.rounds[i].block_sets);
    }
    EXPECT_GT(pixels_of(first.rounds[1]), 0U);
    EXPECT_GT(pixels_of(first.rounds[2]), 0U);
}

TEST(LevelScheduler, NothingLitNeedsNothing) {
    for (const TileGrid& grid : test::small_images()) {
        MadeUpImage image(grid);
        image.take_masks();
        for (const double threshold : {0.0, 1.0}) {
            const Frame frame = run_frame(image, threshold, [](auto, auto) { return 1.0F; });
            for (const WorkList& list : frame.rounds) EXPECT_TRUE(list.pixels.empty());
            if (threshold > 0.0) {
                for (const Level level : frame.levels) EXPECT_EQ(level, Level::coarse);
            }
        }
    }
}

TEST(LevelScheduler, EvenLightStaysCoarse) {
    for (const float value : {0.0F, 1e-30F, 1e-3F, 7.0F, 1e30F}) {
        const Frame frame = run_frame(plain({61, 43}), 0.01, [&](auto, auto) { return value; });
        for (const Level level : frame.levels) EXPECT_EQ(level, Level::coarse) << value;
        EXPECT_EQ(pixels_of(frame.rounds[1]) + pixels_of(frame.rounds[2]), 0U) << value;
    }
}

TEST(LevelScheduler, AnEdgeIsSampledFullyAndNothingFarFromIt) {
    const TileGrid grid{96, 96};
    const Frame frame =
        run_frame(plain(grid), 1.0, [](auto x, auto) { return x < 50 ? 0.1F : 10.0F; });
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
        const std::uint32_t column = tile % grid.columns();
        if (column == 5 || column == 6) {
            EXPECT_EQ(frame.levels[tile], Level::full) << tile;
        } else if (column < 4 || column > 7) {
            EXPECT_EQ(frame.levels[tile], Level::coarse) << tile;
        }
    }
}

TEST(LevelScheduler, WhatIsNotFiniteIsSampledFully) {
    const TileGrid grid{96, 96};
    for (const float value :
         {bad, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()})
        for (const double threshold : {1.0, 1e300, infinity}) {
            const Frame frame = run_frame(plain(grid), threshold, [&](auto x, auto y) {
                return x / 8 == 4 && y / 8 == 6 ? value : 1.0F;
            });
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
                const std::uint32_t column = tile % grid.columns();
                const std::uint32_t row = tile / grid.columns();
                if (column == 4 && row == 6) {
                    EXPECT_EQ(frame.levels[tile], Level::full) << value << ' ' << threshold;
                } else if (column < 2 || column > 6 || row < 4 || row > 8) {
                    EXPECT_EQ(frame.levels[tile], Level::coarse) << tile << ' ' << value;
                }
            }
        }
}

}  // namespace
}  // namespace weft::level_scheduler_test
