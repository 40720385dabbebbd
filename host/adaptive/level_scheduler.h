// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_LEVEL_SCHEDULER_H
#define WEFT_ADAPTIVE_LEVEL_SCHEDULER_H

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "adaptive/brightness.h"
#include "adaptive/level_hysteresis.h"
#include "plan/tile_masks.h"
#include "plan/work_list.h"

namespace weft {

/// How large an error the undersampling of a component may have, and how errors are judged.
struct LevelSettings {
    std::uint32_t interleave = 3;
    /// Largest error of interpolation, in just noticeable differences on the display; 0: every
    /// pixel is sampled.
    double threshold = 8.0;
    double luminance_scale = 100.0;  ///< cd/m^2 on the display of radiance 1
};

/// Decides, round by round, which pixels of a component get samples. Pure: the same records and
/// signals give the same work lists, whatever the device and the order of tiles.
class LevelScheduler {
  public:
    /// `records`: one per tile of the grid.
    LevelScheduler(const TileGrid& grid, const LevelSettings& settings,
                   std::span<const shared::TileRecord> records);

    /// The pixels that the levels now require and that have no samples yet. The first round is the
    /// coarse lattice, and the pixels that geometry requires in any case.
    [[nodiscard]] WorkList next_round();

    /// Whether any tile is to be judged at that level.
    [[nodiscard]] bool has(Level level) const;

    /// Raises every tile to this level at least, before the next round.
    void require(std::span<const Level> least);

    /// Raises every tile to the level at which it is held, but not above `most`, from the next
    /// round on; it is judged as if it were not held. Holding up to the middle level before the
    /// coarse lattice is judged, and up to any level afterwards, keeps samples that are only held
    /// out of every judgement.
    void hold(std::span<const Level> held, Level most);

    /// The round after the lattice of `examined` (coarse or middle) has its samples: raises tiles
    /// where interpolation would err visibly, by two levels where one is not enough. `signal`: what
    /// lattice_signal.cl wrote for it; `slope`: what is visible on the display.
    [[nodiscard]] WorkList refine(Level examined, std::span<const shared::float4> signal,
                                  const BrightnessSlope& slope);

    /// Fades all tiles from their heights in the image before, and adds the samples which that
    /// needs to the next round, which must be the last. Leaves the judgement of tiles as it is.
    void fade_from(std::span<const float> earlier);

    [[nodiscard]] std::span<const Level> levels() const { return levels_; }
    /// The height at which the image shows each tile: that of its level, unless the tile fades
    /// (level_fade.h).
    [[nodiscard]] std::vector<float> heights() const;
    /// The levels that the errors of the rounds so far require.
    [[nodiscard]] const LevelVerdict& verdict() const { return verdict_; }
    /// Largest error that interpolation of the coarse or the middle lattice would make in each
    /// tile, in just noticeable differences; 0 where that was not judged, NaN where a signal was
    /// not finite.
    [[nodiscard]] std::span<const float> errors(Level examined) const {
        return errors_.at(static_cast<std::size_t>(examined));
    }
    /// Whether a higher threshold might save samples of a frame like this: some tile is held or
    /// raised by its error.
    [[nodiscard]] bool can_save() const;
    /// Whether a lower threshold might add samples: some tile is below the full level.
    [[nodiscard]] bool can_spend() const;
    /// Number of tiles of each level.
    [[nodiscard]] std::array<std::uint32_t, 3> tiles_by_level() const;
    /// Number of pixels that have samples.
    [[nodiscard]] std::uint64_t samples() const;
    /// Pixels that have samples, by tile.
    [[nodiscard]] std::span<const TileMask> sampled() const { return sampled_; }

  private:
    /// Whether the errors of the lattice of `examined` decide on a tile that the errors of coarser
    /// lattices have raised to `judged`.
    [[nodiscard]] bool is_judged(std::size_t tile, Level examined, Level judged) const;
    [[nodiscard]] float tile_error(std::uint32_t tile, Level examined,
                                   std::span<const float> errors) const;
    void raise(Level examined, std::span<const float> errors);
    [[nodiscard]] std::vector<TileMask> masks_of_heights() const;

    TileGrid grid_;
    LevelSettings settings_;
    std::vector<Level> base_;     ///< required by geometry and by least levels
    std::vector<Level> levels_;   ///< the highest of base_, the verdict and the held level
    std::vector<float> earlier_;  ///< heights to fade from; empty where nothing fades
    LevelVerdict verdict_;
    std::array<std::vector<float>, 2> errors_;  ///< by tile, of the coarse and the middle lattice
    std::vector<TileMask> lit_;
    std::vector<TileMask> fine_;  ///< pixels that need samples of their own, and neighbours
    std::vector<TileMask> sampled_;
};

/// Expected error, in just noticeable differences, of interpolating between the 3 x 3 means of each
/// lattice point: from second differences of the means, times the point's reflectance, as visible
/// on top of its other light. 0 where a point has no sample; NaN where its signal is not finite.
[[nodiscard]] std::vector<float> interpolation_errors(std::uint32_t columns, std::uint32_t rows,
                                                      std::span<const shared::float4> signal,
                                                      const BrightnessSlope& slope);

}  // namespace weft

#endif
