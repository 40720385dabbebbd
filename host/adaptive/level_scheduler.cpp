// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/level_scheduler.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "adaptive/level_fade.h"

namespace weft {
namespace {

/// Error per second difference d of the means: between two points interpolation errs by up to
/// d / 8, and the mean itself by d / 3 more than that of full sampling.
constexpr float curvature_share = 0.125F + 0.333F;
/// Error per first difference, which is used where only one neighbour is on the surface.
constexpr float slope_share = 0.25F;

/// Factor by which half the stride divides second differences, and with them the error.
constexpr float halving_gain = 4.0F;

/// Offsets of the eight neighbours in the order of their bits.
constexpr std::array<std::array<int, 2>, 8> neighbours{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
constexpr unsigned up = 1;
constexpr unsigned left = 3;
constexpr unsigned right = 4;
constexpr unsigned down = 6;

bool has(std::uint32_t bits, unsigned neighbour) {
    return (bits >> neighbour & 1U) != 0;
}

std::uint32_t bits_of(const shared::float4& point) {
    return static_cast<std::uint32_t>(point.w);
}

std::vector<float> means(std::uint32_t columns, std::span<const shared::float4> signal) {
    std::vector<float> result(signal.size());
    for (std::size_t i = 0; i < signal.size(); ++i) {
        const std::uint32_t bits = bits_of(signal[i]);
        if (bits == 0) continue;
        float sum = signal[i].x;
        int count = 1;
        for (unsigned n = 0; n < neighbours.size(); ++n) {
            if (!has(bits, n)) continue;
            const auto offset = neighbours[n][0] + neighbours[n][1] * static_cast<int>(columns);
            sum += signal[i + static_cast<std::size_t>(offset)].x;
            ++count;
        }
        result[i] = sum / static_cast<float>(count);
    }
    return result;
}

/// Error along one axis, in irradiance.
float axis_error(std::span<const float> mean, std::size_t at, std::size_t step, bool before,
                 bool after) {
    if (before && after)
        return curvature_share * std::abs(mean[at - step] + mean[at + step] - 2.0F * mean[at]);
    if (before) return slope_share * std::abs(mean[at - step] - mean[at]);
    if (after) return slope_share * std::abs(mean[at + step] - mean[at]);
    return 0.0F;
}

/// The level that an error of interpolating the lattice of `examined` requires, two steps up where
/// one is not enough; coarse where the error is below the threshold.
Level asked_level(Level examined, float error, float threshold) {
    if (error < threshold) return Level::coarse;
    const bool both = examined == Level::middle || !(error < halving_gain * threshold);
    return both ? Level::full : Level::middle;
}

/// The larger error; one that is not a number is the largest.
float worse(float a, float b) {
    return a >= b || std::isnan(a) ? a : b;
}

}  // namespace

std::vector<float> interpolation_errors(std::uint32_t columns, std::uint32_t rows,
                                        std::span<const shared::float4> signal,
                                        const BrightnessSlope& slope) {
    const std::vector<float> mean = means(columns, signal);
    std::vector<float> errors(std::size_t{columns} * rows, 0.0F);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const std::uint32_t bits = bits_of(signal[i]);
        if ((bits & LATTICE_SAMPLED) == 0) continue;
        const float error = axis_error(mean, i, 1, has(bits, left), has(bits, right)) +
                            axis_error(mean, i, columns, has(bits, up), has(bits, down));
        const float reflectance = signal[i].y;
        errors[i] = error * reflectance * slope(reflectance * mean[i] + signal[i].z);
    }
    return errors;
}

LevelScheduler::LevelScheduler(const TileGrid& grid, const LevelSettings& settings,
                               std::span<const shared::TileRecord> records)
    : grid_(grid),
      settings_(settings),
      base_(records.size(), settings.threshold > 0.0 ? Level::coarse : Level::full),
      verdict_{std::vector<Level>(records.size(), Level::coarse),
               std::vector<Level>(records.size(), Level::coarse)},
      errors_{std::vector<float>(records.size(), 0.0F), std::vector<float>(records.size(), 0.0F)},
      lit_(records.size()),
      fine_(records.size()),
      sampled_(records.size(), 0) {
    for (std::size_t tile = 0; tile < records.size(); ++tile) {
        lit_[tile] = mask_of(records[tile].lit);
        fine_[tile] = mask_of(records[tile].fine);
        if (mask_of(records[tile].middle) != 0) base_[tile] = std::max(base_[tile], Level::middle);
    }
    levels_ = base_;
    fine_ = footprint_masks(grid_, fine_);
}

std::array<std::uint32_t, 3> LevelScheduler::tiles_by_level() const {
    std::array<std::uint32_t, 3> counts{};
    for (const Level level : levels_) ++counts.at(static_cast<std::size_t>(level));
    return counts;
}

std::uint64_t LevelScheduler::samples() const {
    std::uint64_t count = 0;
    for (const TileMask mask : sampled_) count += static_cast<std::uint64_t>(std::popcount(mask));
    return count;
}

bool LevelScheduler::can_save() const {
    return levels_ != base_;
}

bool LevelScheduler::can_spend() const {
    return std::find_if(levels_.begin(), levels_.end(),
                        [](Level level) { return level != Level::full; }) != levels_.end();
}

bool LevelScheduler::is_judged(std::size_t tile, Level examined, Level judged) const {
    return std::max(base_[tile], judged) == examined && levels_[tile] >= examined;
}

bool LevelScheduler::has(Level level) const {
    for (std::size_t tile = 0; tile < levels_.size(); ++tile)
        if (is_judged(tile, level, verdict_.asked[tile]) ||
            is_judged(tile, level, verdict_.kept[tile]))
            return true;
    return false;
}

void LevelScheduler::require(std::span<const Level> least) {
    for (std::size_t tile = 0; tile < levels_.size(); ++tile) {
        base_[tile] = std::max(base_[tile], least[tile]);
        levels_[tile] = std::max(levels_[tile], base_[tile]);
    }
}

void LevelScheduler::hold(std::span<const Level> held, Level most) {
    for (std::size_t tile = 0; tile < levels_.size(); ++tile)
        levels_[tile] = std::max(levels_[tile], std::min(held[tile], most));
}

WorkList LevelScheduler::refine(Level examined, std::span<const shared::float4> signal,
                                const BrightnessSlope& slope) {
    const std::uint32_t stride = stride_of(examined);
    const std::uint32_t columns = (grid_.width - 1) / stride + 1;
    const std::uint32_t rows = (grid_.height - 1) / stride + 1;
    raise(examined, interpolation_errors(columns, rows, signal, slope));
    return next_round();
}

float LevelScheduler::tile_error(std::uint32_t tile, Level examined,
                                 std::span<const float> errors) const {
    const std::uint32_t stride = stride_of(examined);
    const std::uint32_t columns = (grid_.width - 1) / stride + 1;
    const std::uint32_t rows = (grid_.height - 1) / stride + 1;
    const std::uint32_t per_tile = TILE_EDGE / stride;
    const std::uint32_t x0 = tile % grid_.columns() * per_tile;
    const std::uint32_t y0 = tile / grid_.columns() * per_tile;
    // The next tile's first points bound this tile's last cells.
    float error = 0.0F;
    for (std::uint32_t y = y0; y <= std::min(y0 + per_tile, rows - 1); ++y)
        for (std::uint32_t x = x0; x <= std::min(x0 + per_tile, columns - 1); ++x)
            error = worse(error, errors[std::size_t{y} * columns + x]);
    return error;
}

void LevelScheduler::raise(Level examined, std::span<const float> errors) {
    const auto threshold = static_cast<float>(settings_.threshold);
    const auto release = static_cast<float>(release_share * settings_.threshold);
    for (std::uint32_t tile = 0; tile < grid_.tiles(); ++tile) {
        const bool asks = is_judged(tile, examined, verdict_.asked[tile]);
        const bool keeps = is_judged(tile, examined, verdict_.kept[tile]);
        if (!asks && !keeps) continue;
        const float error = tile_error(tile, examined, errors);
        errors_.at(static_cast<std::size_t>(examined))[tile] = error;
        const auto raise_to = [](Level& level, Level asked) { level = std::max(level, asked); };
        if (asks) raise_to(verdict_.asked[tile], asked_level(examined, error, threshold));
        if (keeps) raise_to(verdict_.kept[tile], asked_level(examined, error, release));
        raise_to(levels_[tile], verdict_.asked[tile]);
    }
}

void LevelScheduler::fade_from(std::span<const float> earlier) {
    earlier_.assign(earlier.begin(), earlier.end());
}

std::vector<float> LevelScheduler::heights() const {
    std::vector<float> heights;
    heights.reserve(levels_.size());
    for (std::size_t tile = 0; tile < levels_.size(); ++tile)
        heights.push_back(earlier_.empty() ? height_of(levels_[tile])
                                           : faded_height(earlier_[tile], levels_[tile]));
    return heights;
}

std::vector<TileMask> LevelScheduler::masks_of_heights() const {
    if (earlier_.empty()) return required_masks(grid_, levels_);
    std::vector<Level> below;
    std::vector<Level> above;
    for (const float height : heights()) {
        below.push_back(level_below(height));
        above.push_back(level_above(height));
    }
    std::vector<TileMask> masks = required_masks(grid_, below);
    const std::vector<TileMask> finer = required_masks(grid_, above);
    for (std::size_t tile = 0; tile < masks.size(); ++tile) masks[tile] |= finer[tile];
    return masks;
}

WorkList LevelScheduler::next_round() {
    std::vector<TileMask> masks = masks_of_heights();
    for (std::size_t tile = 0; tile < masks.size(); ++tile) {
        masks[tile] = (masks[tile] | fine_[tile]) & lit_[tile] & ~sampled_[tile];
        sampled_[tile] |= masks[tile];
    }
    return make_work_list(grid_, masks, settings_.interleave);
}

}  // namespace weft
