// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_LEVEL_HYSTERESIS_H
#define WEFT_ADAPTIVE_LEVEL_HYSTERESIS_H

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plan/tile_masks.h"

namespace weft {

/// Share of its threshold below which an error no longer speaks for the level it once asked for.
inline constexpr double release_share = 0.7;

/// Pictures in a row of such errors for which a tile keeps its level.
inline constexpr std::uint32_t quiet_pictures = 4;

/// What the errors of one frame say of every tile; coarse where they ask for nothing, or where
/// geometry and shadows already ask for as much.
struct LevelVerdict {
    std::vector<Level> asked;  ///< levels that errors at the threshold ask for
    std::vector<Level> kept;   ///< the same at release_share of it; at least `asked`
};

/// The memory of a picture sequence: keeps a tile whose error wavers about the threshold from
/// changing its level from picture to picture. Levels that errors ask for are held until the error
/// was below release_share of the threshold in quiet_pictures pictures in a row. Nothing is ever
/// delayed upwards, and levels that geometry or shadows ask for are not its business: they follow
/// each picture.
class LevelHysteresis {
  public:
    explicit LevelHysteresis(std::size_t tiles);

    /// Forgets all: the next picture is the first of a sequence.
    void begin_sequence();
    /// The next picture of the sequence.
    void begin_picture();

    /// Adds what a frame of the picture says. A picture's frames speak together: its verdict is the
    /// highest of theirs.
    void add(const LevelVerdict& frame);

    /// The level that earlier pictures of the sequence hold each tile at; coarse where none does.
    /// The same for all frames of a picture.
    [[nodiscard]] std::vector<Level> held() const;

  private:
    /// Of middle and full: pictures in a row since errors spoke for at least that level, up to
    /// quiet_pictures, at which it is not held.
    using Quiet = std::array<std::uint8_t, 2>;

    void clear_verdict();

    std::vector<Quiet> quiet_;
    LevelVerdict verdict_;  ///< of the picture under way
    bool judged_ = false;   ///< it has one
};

}  // namespace weft

#endif
