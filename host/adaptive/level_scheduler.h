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

    /// Whether any tile is to be judged at that level.
    [[nodiscard]] bool has(Level level) const;

    /// Raises every tile to this level at least, before the next round.
    void require(std::span<const Level> least);

    /// Samples every tile at the level that is held, or at `most`, at least, from the next round
    /// on, but judges it as if it were not held. Holding up to the middle level before the coarse
    /// lattice is judged, and then all, lets no judgement see samples that it would not have
    /// without.
    void hold(std::span<const Level> held, Level most);

    /// The round after the lattice of `examined` (coarse or middle) has its samples: raises tiles
    /// where interpolation would err visibly, by two levels where one will not do. `signal`: what
    /// lattice_signal.cl wrote for it; `slope`: what is visible on the display.
    [[nodiscard]] WorkList refine(Level examined, std::span<const shared::float4> signal,
                                  const BrightnessSlope& slope);

    /// Fades all tiles from their heights in the picture before, and adds what that needs to the
    /// samples of the next round, which is to be the last. Judges nothing otherwise.
    void fade_from(std::span<const float> earlier);

    [[nodiscard]] std::span<const Level> levels() const { return levels_; }
    /// What the picture is to show of each tile: its level, unless it fades (level_fade.h).
    [[nodiscard]] std::vector<float> heights() const;
    /// What the errors of the rounds so far say.
    [[nodiscard]] const LevelVerdict& verdict() const { return verdict_; }
    /// Largest error that interpolation of the coarse or the middle lattice would make in each
    /// tile, just noticeable differences; 0 where that was not judged, NaN where a signal was not
    /// finite.
    [[nodiscard]] std::span<const float> errors(Level examined) const {
        return errors_.at(static_cast<std::size_t>(examined));
    }
    /// Whether another threshold might change the samples of a frame like this: some tile is held
    /// or raised by its error, or is below the full level.
    [[nodiscard]] bool can_save() const;
    [[nodiscard]] bool can_spend() const;
    /// Tiles of each level.
    [[nodiscard]] std::array<std::uint32_t, 3> tiles_by_level() const;
    /// Pixels that have samples.
    [[nodiscard]] std::uint64_t samples() const;
    /// Pixels that have samples, by tile.
    [[nodiscard]] std::span<const TileMask> sampled() const { return sampled_; }

  private:
    /// Whether the errors of that lattice are to decide on a tile, which they have so far brought
    /// to `judged`.
    [[nodiscard]] bool is_judged(std::size_t tile, Level examined, Level judged) const;
    [[nodiscard]] float tile_error(std::uint32_t tile, Level examined,
                                   std::span<const float> errors) const;
    void raise(Level examined, std::span<const float> errors);
    [[nodiscard]] std::vector<TileMask> masks_of_heights() const;

    TileGrid grid_;
    LevelSettings settings_;
    std::vector<Level> base_;     ///< what geometry and least levels ask for
    std::vector<Level> levels_;   ///< of these, the verdict and what is held the highest
    std::vector<float> earlier_;  ///< heights to fade from; none where nothing fades
    LevelVerdict verdict_;
    std::array<std::vector<float>, 2> errors_;  ///< by tile, of the coarse and the middle lattice
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
