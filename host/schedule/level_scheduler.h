// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCHEDULE_LEVEL_SCHEDULER_H
#define WEFT_SCHEDULE_LEVEL_SCHEDULER_H

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "schedule/brightness.h"
#include "schedule/tile_masks.h"
#include "schedule/work_list.h"

namespace weft {

/// When undersampling a component is good enough.
struct LevelSettings {
    std::uint32_t interleave = 3;
    /// Largest error of interpolation, in just noticeable differences on the display; 0: every
    /// pixel is sampled.
    double threshold = 8.0;
    double luminance_scale = 100.0;  ///< cd/m^2 of radiance 1
};

/// Decides, round by round, which pixels of a component get samples. Pure: the same records and
/// signals give the same work lists, whatever the device and the order of tiles.
class LevelScheduler {
  public:
    /// `records`: one per tile of the grid.
    LevelScheduler(const TileGrid& grid, const LevelSettings& settings,
                   std::span<const shared::TileRecord> records);

    /// The pixels that the levels now ask for and that have no samples yet. The first round is the
    /// coarse lattice, and what the geometry wants in any case.
    [[nodiscard]] WorkList next_round();

    /// Whether any tile has that level.
    [[nodiscard]] bool has(Level level) const;

    /// Raises every tile to this level at least, before the next round.
    void require(std::span<const Level> least);

    /// The round after the lattice of `examined` (coarse or middle) has its samples: raises tiles
    /// where interpolation would err visibly, by two levels where one will not do. `signal`: what
    /// lattice_signal.cl wrote for it.
    [[nodiscard]] WorkList refine(Level examined, std::span<const shared::float4> signal);

    [[nodiscard]] std::span<const Level> levels() const { return levels_; }
    /// Tiles of each level.
    [[nodiscard]] std::array<std::uint32_t, 3> tiles_by_level() const;
    /// Pixels that have samples.
    [[nodiscard]] std::uint64_t samples() const;
    /// Pixels that have samples, by tile.
    [[nodiscard]] std::span<const TileMask> sampled() const { return sampled_; }

  private:
    void raise(Level examined, std::span<const float> errors);

    TileGrid grid_;
    LevelSettings settings_;
    std::vector<Level> levels_;
    std::vector<TileMask> lit_;
    std::vector<TileMask> fine_;  ///< pixels that need samples of their own, and neighbours
    std::vector<TileMask> sampled_;
};

/// Expected error, in just noticeable differences, of interpolating between the 3 x 3 means of each
/// lattice point: from second differences of the means, seen with the point's reflectance and
/// beside its other light. 0 where a point has no sample; NaN where its signal is not finite.
[[nodiscard]] std::vector<float> interpolation_errors(std::uint32_t columns, std::uint32_t rows,
                                                      std::span<const shared::float4> signal,
                                                      const BrightnessSlope& slope);

}  // namespace weft

#endif
