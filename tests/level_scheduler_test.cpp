// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "schedule/level_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "picture_masks.h"

// The scheduler alone: pictures and signals are made up, and a frame is run as AdaptiveSampling
// runs it.
namespace weft {
namespace {

using test::in_mask;
using test::Uniform;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr float bad = std::numeric_limits<float>::quiet_NaN();

/// Irradiance by pixel.
using Signal = std::function<float(std::uint32_t x, std::uint32_t y)>;

/// What the G-buffer says of a picture.
struct Picture {
    TileGrid grid;
    std::vector<shared::TileRecord> records;
    std::vector<TileMask> lit, fine;

    explicit Picture(const TileGrid& size) : grid(size), records(size.tiles()) {}

    void set(std::uint32_t tile, TileMask lit_pixels, TileMask middle, TileMask fine_pixels) {
        const auto words = [](std::uint32_t(&to)[2], TileMask mask) {
            to[0] = static_cast<std::uint32_t>(mask);
            to[1] = static_cast<std::uint32_t>(mask >> 32);
        };
        words(records[tile].lit, lit_pixels);
        words(records[tile].middle, middle);
        words(records[tile].fine, fine_pixels);
    }
    void take_masks() {
        for (const shared::TileRecord& record : records) {
            lit.push_back(mask_of(record.lit));
            fine.push_back(mask_of(record.fine));
        }
    }
};

TileMask inside(const TileGrid& grid, std::uint32_t tile) {
    TileMask mask = 0;
    for (std::uint32_t bit = 0; bit < 64; ++bit)
        if (tile % grid.columns() * TILE_EDGE + bit % TILE_EDGE < grid.width &&
            tile / grid.columns() * TILE_EDGE + bit / TILE_EDGE < grid.height)
            mask |= TileMask{1} << bit;
    return mask;
}

/// Everything lit, one smooth surface.
Picture plain(const TileGrid& grid) {
    Picture picture(grid);
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
        picture.set(tile, inside(grid, tile), 0, 0);
    picture.take_masks();
    return picture;
}

Picture random_picture(const TileGrid& grid, Uniform& random) {
    Picture picture(grid);
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
        const TileMask lit =
            inside(grid, tile) & (random.below(3) == 0 ? random.mask() : ~TileMask{0});
        const TileMask special = random.below(2) == 0 ? random.mask() & random.mask() : 0;
        const TileMask which = random.below(2) == 0 ? random.mask() : ~TileMask{0};
        picture.set(tile, lit, lit & special & which, lit & special & ~which);
    }
    picture.take_masks();
    return picture;
}

Signal random_signal(Uniform& random) {
    const float a = random.unit();
    const float b = random.unit();
    return [a, b](std::uint32_t x, std::uint32_t y) {
        const float step = x > 20 && y > 11 ? 3.0F : 0.0F;
        return 1.0F + std::sin(a * static_cast<float>(x)) * std::cos(b * static_cast<float>(y)) +
               step;
    };
}

/// What lattice_signal.cl writes where `sampled` pixels have samples of one smooth surface.
std::vector<shared::float4> lattice_signal(const TileGrid& grid, std::uint32_t stride,
                                           const std::vector<TileMask>& sampled,
                                           const Signal& irradiance, float reflectance = 0.2F,
                                           float other = 0.0F) {
    std::vector<shared::float4> signal;
    for (std::uint32_t y = 0; y < grid.height; y += stride)
        for (std::uint32_t x = 0; x < grid.width; x += stride) {
            signal.push_back({0.0F, 0.0F, 0.0F, 0.0F});
            if (!in_mask(grid, sampled, x, y)) continue;
            std::uint32_t bits = LATTICE_SAMPLED;
            std::uint32_t bit = 1;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    if (i == 0 && j == 0) continue;
                    // Beyond the left and upper border these wrap to what is no pixel.
                    const std::uint32_t u = x + static_cast<std::uint32_t>(i) * stride;
                    const std::uint32_t v = y + static_cast<std::uint32_t>(j) * stride;
                    if (u < grid.width && v < grid.height && in_mask(grid, sampled, u, v))
                        bits |= bit;
                    bit <<= 1;
                }
            signal.back() = {irradiance(x, y), reflectance, other, static_cast<float>(bits)};
        }
    return signal;
}

struct Frame {
    std::vector<Level> levels;
    std::vector<TileMask> sampled;
    std::vector<WorkList> rounds;
};

LevelSettings settings_of(double threshold) {
    LevelSettings settings;
    settings.threshold = threshold;
    return settings;
}

/// A frame. Where `complete`, signals are those of a picture in which every pixel has a sample.
Frame run_frame(const Picture& picture, double threshold, const Signal& irradiance,
                bool complete = false, const std::vector<Level>& least = {}) {
    LevelScheduler scheduler(picture.grid, settings_of(threshold), picture.records);
    const auto sampled = [&] {
        const auto masks = scheduler.sampled();
        return std::vector<TileMask>(masks.begin(), masks.end());
    };
    Frame frame;
    frame.rounds.push_back(scheduler.next_round());
    if (!least.empty()) scheduler.require(least);
    for (const Level level : {Level::coarse, Level::middle})
        frame.rounds.push_back(
            scheduler.has(level)
                ? scheduler.refine(level,
                                   lattice_signal(picture.grid, stride_of(level),
                                                  complete ? picture.lit : sampled(), irradiance))
                : scheduler.next_round());
    frame.levels.assign(scheduler.levels().begin(), scheduler.levels().end());
    frame.sampled = sampled();
    return frame;
}

std::size_t pixels_of(const WorkList& list) {
    return static_cast<std::size_t>(std::count_if(list.pixels.begin(), list.pixels.end(),
                                                  [](auto p) { return p != NO_TRIANGLE; }));
}

std::size_t pixels_of(const std::vector<TileMask>& masks) {
    std::size_t count = 0;
    for (const TileMask mask : masks) count += static_cast<std::size_t>(std::popcount(mask));
    return count;
}

std::string text_of(const TileGrid& grid) {
    return std::to_string(grid.width) + "x" + std::to_string(grid.height);
}

TEST(LevelScheduler, RoundsHoldEverySampledPixelOnceAndOnlyLitOnes) {
    Uniform random(1);
    for (const TileGrid& grid : test::small_pictures())
        for (const double threshold : {0.0, 1e-3, 0.3, 3.0, infinity}) {
            SCOPED_TRACE(text_of(grid) + ", threshold " + std::to_string(threshold));
            const Picture picture = random_picture(grid, random);
            const Frame frame = run_frame(picture, threshold, random_signal(random));
            std::vector<int> count(std::size_t{grid.width} * grid.height, 0);
            for (const WorkList& list : frame.rounds)
                for (const std::uint32_t pixel : list.pixels)
                    if (pixel != NO_TRIANGLE) ++count.at(pixel);
            for (std::uint32_t y = 0; y < grid.height; ++y)
                for (std::uint32_t x = 0; x < grid.width; ++x)
                    ASSERT_EQ(count[std::size_t{y} * grid.width + x],
                              in_mask(grid, frame.sampled, x, y) ? 1 : 0)
                        << x << ' ' << y;
            std::size_t all = 0;
            for (const WorkList& list : frame.rounds) all += pixels_of(list);
            EXPECT_EQ(all, pixels_of(frame.sampled));
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
                EXPECT_EQ(frame.sampled[tile] & ~picture.lit[tile], 0U) << "tile " << tile;
        }
}

TEST(LevelScheduler, TheFirstRoundHoldsTheCoarseLatticeAndWhatTheGeometryWants) {
    Uniform random(2);
    for (const TileGrid& grid : test::small_pictures()) {
        const Picture picture = random_picture(grid, random);
        LevelScheduler scheduler(grid, settings_of(infinity), picture.records);
        const WorkList first = scheduler.next_round();
        std::vector<bool> there(std::size_t{grid.width} * grid.height, false);
        for (const std::uint32_t pixel : first.pixels)
            if (pixel != NO_TRIANGLE) there[pixel] = true;
        for (std::uint32_t y = 0; y < grid.height; ++y)
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const bool coarse = x % 4 == 0 && y % 4 == 0;
                if (in_mask(grid, picture.lit, x, y) &&
                    (coarse || in_mask(grid, picture.fine, x, y))) {
                    EXPECT_TRUE(there[std::size_t{y} * grid.width + x])
                        << text_of(grid) << ": " << x << ' ' << y;
                }
            }
    }
}

TEST(LevelScheduler, SamplesOfEverythingThatReconstructionReads) {
    // As reconstruct_tiles.cl chooses the stride of a pixel.
    Uniform random(3);
    for (const TileGrid& grid : test::small_pictures())
        for (const double threshold : {0.3, 3.0, infinity}) {
            const Picture picture = random_picture(grid, random);
            const Frame frame = run_frame(picture, threshold, random_signal(random));
            std::size_t missing = 0;
            for (std::uint32_t y = 0; y < grid.height; ++y)
                for (std::uint32_t x = 0; x < grid.width; ++x) {
                    if (!in_mask(grid, picture.lit, x, y)) continue;
                    const std::uint32_t tile = y / TILE_EDGE * grid.columns() + x / TILE_EDGE;
                    const std::uint32_t stride =
                        in_mask(grid, picture.fine, x, y) ? 1 : stride_of(frame.levels[tile]);
                    if (mask_of(picture.records[tile].middle) != 0) {
                        EXPECT_LE(stride, 2U);
                    }
                    test::for_support(grid, x, y, stride, [&](std::uint32_t u, std::uint32_t v) {
                        missing +=
                            in_mask(grid, picture.lit, u, v) && !in_mask(grid, frame.sampled, u, v)
                                ? 1
                                : 0;
                    });
                }
            EXPECT_EQ(missing, 0U) << text_of(grid) << ", threshold " << threshold;
        }
}

TEST(LevelScheduler, ThresholdZeroSamplesEveryLitPixelAtOnce) {
    Uniform random(4);
    for (const TileGrid& grid : test::small_pictures())
        for (const double threshold : {0.0, -1.0, static_cast<double>(bad)}) {
            const Picture picture = random_picture(grid, random);
            LevelScheduler scheduler(grid, settings_of(threshold), picture.records);
            EXPECT_EQ(pixels_of(scheduler.next_round()), pixels_of(picture.lit)) << text_of(grid);
            for (const Level level : scheduler.levels()) EXPECT_EQ(level, Level::full);
        }
}

TEST(LevelScheduler, CountsItsTilesAndSamples) {
    Uniform random(8);
    for (const TileGrid& grid : test::small_pictures()) {
        const Picture picture = random_picture(grid, random);
        LevelScheduler scheduler(grid, settings_of(1.0), picture.records);
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
    Uniform random(5);
    for (const TileGrid& grid : test::small_pictures()) {
        const Picture picture = random_picture(grid, random);
        const Signal signal = random_signal(random);
        std::vector<Level> before(grid.tiles(), Level::full);
        for (const double threshold : {0.0, 1e-3, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, infinity}) {
            const std::vector<Level> levels = run_frame(picture, threshold, signal, true).levels;
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
                EXPECT_LE(levels[tile], before[tile]) << text_of(grid) << ", tile " << tile;
            before = levels;
        }
        for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
            EXPECT_EQ(before[tile],
                      mask_of(picture.records[tile].middle) != 0 ? Level::middle : Level::coarse);
    }
}

TEST(LevelScheduler, RequiredLevelsAreLeastLevels) {
    Uniform random(6);
    const TileGrid grid{61, 43};
    const Picture picture = random_picture(grid, random);
    const Signal signal = random_signal(random);
    const Frame free = run_frame(picture, 1.0, signal, true);
    std::vector<Level> least;
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
        least.push_back(static_cast<Level>(random.below(3)));
    const Frame bound = run_frame(picture, 1.0, signal, true, least);
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
        EXPECT_GE(bound.levels[tile], least[tile]);
        // From middle on it is judged by the finer lattice alone.
        if (least[tile] == Level::coarse) {
            EXPECT_EQ(bound.levels[tile], free.levels[tile]);
        }
    }
}

TEST(LevelScheduler, EqualInputsGiveEqualLists) {
    Uniform random(7);
    const TileGrid grid{134, 140};
    const Picture picture = random_picture(grid, random);
    const Signal signal = random_signal(random);
    const Frame first = run_frame(picture, 1.0, signal);
    const Frame second = run_frame(picture, 1.0, signal);
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
    for (const TileGrid& grid : test::small_pictures()) {
        Picture picture(grid);
        picture.take_masks();
        for (const double threshold : {0.0, 1.0}) {
            const Frame frame = run_frame(picture, threshold, [](auto, auto) { return 1.0F; });
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
}  // namespace weft
