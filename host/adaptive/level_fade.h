// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_LEVEL_FADE_H
#define WEFT_ADAPTIVE_LEVEL_FADE_H

#include <span>
#include <vector>

#include "plan/tile_masks.h"

namespace weft {

/// How far a tile's height may fall from one picture to the next; a power of two, so that heights
/// are exact.
inline constexpr float fade_step = 0x1p-4F;

/// Heights of tiles are 0, 1 and 2 for the coarse, middle and full level; between two of them a
/// height is that of the coarser one and the share of the finer in what a picture shows of a tile.
[[nodiscard]] constexpr float height_of(Level level) {
    return static_cast<float>(level);
}

/// The next level down from a height in [0, 2], and the next one up; both are the same at a level.
[[nodiscard]] Level level_below(float height);
[[nodiscard]] Level level_above(float height);

/// The height of a tile that is wanted at a level and had the height `earlier` in the picture
/// before: it rises at once and falls by fade_step.
[[nodiscard]] float faded_height(float earlier, Level wanted);

/// What the pictures of a sequence show of each tile. A tile that is no longer wanted as finely is
/// faded over some pictures: at once, the error that is now let pass would be seen to come.
class LevelFade {
  public:
    /// Forgets all: the next picture is the first of a sequence.
    void begin_sequence();
    /// The next picture of the sequence.
    void begin_picture();

    /// Takes the heights of a whole frame, one per tile; a picture's last frame counts.
    void show(std::vector<float> heights);

    /// Heights in the picture before; empty where there is none. The same for all frames of a
    /// picture.
    [[nodiscard]] std::span<const float> earlier() const { return earlier_; }

  private:
    std::vector<float> earlier_;
    std::vector<float> shown_;  ///< by the picture under way
};

}  // namespace weft

#endif
