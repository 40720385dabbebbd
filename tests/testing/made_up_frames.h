// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_MADE_UP_FRAMES_H
#define WEFT_TESTS_TESTING_MADE_UP_FRAMES_H

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "adaptive/level_scheduler.h"
#include "tests/testing/image_masks.h"

// Frames for the scheduler alone: images and signals are made up, and a frame is run as
// AdaptiveSampling runs it.
namespace weft::test {

/// Irradiance by pixel.
using Signal = std::function<float(std::uint32_t x, std::uint32_t y)>;

/// What the G-buffer says of an image.
struct MadeUpImage {
    TileGrid grid;
    std::vector<shared::TileRecord> records;
    std::vector<TileMask> lit, fine;

    explicit MadeUpImage(const TileGrid& size) : grid(size), records(size.tiles()) {}

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

inline TileMask inside(const TileGrid& grid, std::uint32_t tile) {
    TileMask mask = 0;
    for (std::uint32_t bit = 0; bit < 64; ++bit)
        if (tile % grid.columns() * TILE_EDGE + bit % TILE_EDGE < grid.width &&
            tile / grid.columns() * TILE_EDGE + bit / TILE_EDGE < grid.height)
            mask |= TileMask{1} << bit;
    return mask;
}

/// Everything lit, one smooth surface.
inline MadeUpImage plain(const TileGrid& grid) {
    MadeUpImage image(grid);
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
        image.set(tile, inside(grid, tile), 0, 0);
    image.take_masks();
    return image;
}

inline MadeUpImage random_image(const TileGrid& grid, RandomBits& random) {
    MadeUpImage image(grid);
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
        const TileMask lit =
            inside(grid, tile) & (random.below(3) == 0 ? random.mask() : ~TileMask{0});
        const TileMask special = random.below(2) == 0 ? random.mask() & random.mask() : 0;
        const TileMask which = random.below(2) == 0 ? random.mask() : ~TileMask{0};
        image.set(tile, lit, lit & special & which, lit & special & ~which);
    }
    image.take_masks();
    return image;
}

inline Signal random_signal(RandomBits& random) {
    const float a = random.unit();
    const float b = random.unit();
    return [a, b](std::uint32_t x, std::uint32_t y) {
        const float step = x > 20 && y > 11 ? 3.0F : 0.0F;
        return 1.0F + std::sin(a * static_cast<float>(x)) * std::cos(b * static_cast<float>(y)) +
               step;
    };
}

/// What lattice_signal.cl writes where `sampled` pixels have samples of one smooth surface.
inline std::vector<shared::float4> lattice_signal(const TileGrid& grid, std::uint32_t stride,
                                                  const std::vector<TileMask>& sampled,
                                                  const Signal& irradiance,
                                                  float reflectance = 0.2F, float other = 0.0F) {
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
    LevelVerdict verdict;
    std::vector<float> heights;
};

inline LevelSettings settings_of(double threshold) {
    LevelSettings settings;
    settings.threshold = threshold;
    return settings;
}

/// A frame. Where `complete`, signals are those of an image in which every pixel has a sample.
inline Frame run_frame(const MadeUpImage& image, double threshold, const Signal& irradiance,
                       bool complete = false, const std::vector<Level>& least = {},
                       const std::vector<Level>& held = {},
                       const std::vector<float>& earlier = {}) {
    const BrightnessSlope slope(100.0);
    LevelScheduler scheduler(image.grid, settings_of(threshold), image.records);
    const auto sampled = [&] {
        const auto masks = scheduler.sampled();
        return std::vector<TileMask>(masks.begin(), masks.end());
    };
    Frame frame;
    frame.rounds.push_back(scheduler.next_round());
    if (!least.empty()) scheduler.require(least);
    for (const Level level : {Level::coarse, Level::middle}) {
        if (!held.empty())
            scheduler.hold(held, level == Level::coarse ? Level::middle : Level::full);
        if (level == Level::middle) scheduler.fade_from(earlier);
        frame.rounds.push_back(
            scheduler.has(level)
                ? scheduler.refine(level,
                                   lattice_signal(image.grid, stride_of(level),
                                                  complete ? image.lit : sampled(), irradiance),
                                   slope)
                : scheduler.next_round());
    }
    frame.verdict = scheduler.verdict();
    frame.levels.assign(scheduler.levels().begin(), scheduler.levels().end());
    frame.sampled = sampled();
    frame.heights = scheduler.heights();
    return frame;
}

inline std::size_t pixels_of(const WorkList& list) {
    return static_cast<std::size_t>(std::count_if(list.pixels.begin(), list.pixels.end(),
                                                  [](auto p) { return p != INVALID_INDEX; }));
}

inline std::size_t pixels_of(const std::vector<TileMask>& masks) {
    std::size_t count = 0;
    for (const TileMask mask : masks) count += static_cast<std::size_t>(std::popcount(mask));
    return count;
}

inline std::string text_of(const TileGrid& grid) {
    return std::to_string(grid.width) + "x" + std::to_string(grid.height);
}

}  // namespace weft::test

#endif
