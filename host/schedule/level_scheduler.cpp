// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "schedule/level_scheduler.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace weft {
namespace {

/// Of a second difference d of the means: between two points interpolation errs by up to d / 8, and
/// the mean itself by d / 3 more than that of full sampling.
constexpr float curvature_share = 0.125F + 0.333F;
/// Where only one neighbour is on the surface the difference to it stands in.
constexpr float slope_share = 0.25F;

/// Half the stride divides second differences, and with them the error, by this.
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
      levels_(records.size(), settings.threshold > 0.0 ? Level::coarse : Level::full),
      lit_(records.size()),
      fine_(records.size()),
      sampled_(records.size(), 0) {
    for (std::size_t tile = 0; tile < records.size(); ++tile) {
        lit_[tile] = mask_of(records[tile].lit);
        fine_[tile] = mask_of(records[tile].fine);
        if (mask_of(records[tile].middle) != 0)
            levels_[tile] = std::max(levels_[tile], Level::middle);
    }
    fine_ = window_masks(grid_, fine_);
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

bool LevelScheduler::has(Level level) const {
    return std::find(levels_.begin(), levels_.end(), level) != levels_.end();
}

void LevelScheduler::require(std::span<const Level> least) {
    for (std::size_t tile = 0; tile < levels_.size(); ++tile)
        levels_[tile] = std::max(levels_[tile], least[tile]);
}

WorkList LevelScheduler::refine(Level examined, std::span<const shared::float4> signal) {
    const std::uint32_t stride = stride_of(examined);
    const std::uint32_t columns = (grid_.width - 1) / stride + 1;
    const std::uint32_t rows = (grid_.height - 1) / stride + 1;
    const BrightnessSlope slope(settings_.luminance_scale);
    raise(examined, interpolation_errors(columns, rows, signal, slope));
    return next_round();
}

void LevelScheduler::raise(Level examined, std::span<const float> errors) {
    const std::uint32_t stride = stride_of(examined);
    const std::uint32_t columns = (grid_.width - 1) / stride + 1;
    const std::uint32_t rows = (grid_.height - 1) / stride + 1;
    const std::uint32_t per_tile = TILE_EDGE / stride;
    const auto threshold = static_cast<float>(settings_.threshold);
    for (std::uint32_t tile = 0; tile < grid_.tiles(); ++tile) {
        if (levels_[tile] != examined) continue;
        const std::uint32_t x0 = tile % grid_.columns() * per_tile;
        const std::uint32_t y0 = tile / grid_.columns() * per_tile;
        // The next tile's first points bound this tile's last cells.
        float error = 0.0F;
        for (std::uint32_t y = y0; y <= std::min(y0 + per_tile, rows - 1); ++y)
            for (std::uint32_t x = x0; x <= std::min(x0 + per_tile, columns - 1); ++x)
                error = worse(error, errors[std::size_t{y} * columns + x]);
        if (error < threshold) continue;
        const bool both = examined == Level::middle || !(error < halving_gain * threshold);
        levels_[tile] = both ? Level::full : Level::middle;
    }
}

WorkList LevelScheduler::next_round() {
    std::vector<TileMask> masks = required_masks(grid_, levels_);
    for (std::size_t tile = 0; tile < masks.size(); ++tile) {
        masks[tile] = (masks[tile] | fine_[tile]) & lit_[tile] & ~sampled_[tile];
        sampled_[tile] |= masks[tile];
    }
    return make_work_list(grid_, masks, settings_.interleave);
}

}  // namespace weft
