// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_LEVEL_FADE_H
#define WEFT_ADAPTIVE_LEVEL_FADE_H

#include <span>
#include <vector>

#include "plan/tile_masks.h"

namespace weft {

/// How far a tile's height may fall from one image to the next; a power of two, so that heights
/// are exact.
inline constexpr float fade_step = 0x1p-4F;

/// The height at which a tile shows one level alone: 0, 1 and 2 for coarse, middle and full. At a
/// height between two of them a tile shows a blend of both, and the fraction of the height is the
/// weight of the finer one.
[[nodiscard]] constexpr float height_of(Level level) {
    return static_cast<float>(level);
}

/// The levels next below and above a height in [0, 2], which are the same at the height of a level.
[[nodiscard]] Level level_below(float height);
[[nodiscard]] Level level_above(float height);

/// The height of a tile that should have the level `wanted` and had the height `earlier` in the
/// image before: it rises at once, but falls by fade_step at most.
[[nodiscard]] float faded_height(float earlier, Level wanted);

/// Fades tiles to coarser levels over several images of a sequence, because an error that appears
/// all at once would be noticed. Keeps the heights at which the images show each tile.
class LevelFade {
  public:
    /// Forgets all: the next image is the first of a sequence.
    void begin_sequence();
    /// The next image of the sequence.
    void begin_image();

    /// Takes the heights of a whole frame, one per tile; an image's last frame counts.
    void show(std::vector<float> heights);

    /// Heights in the image before; empty where there is none. The same for all frames of an
    /// image.
    [[nodiscard]] std::span<const float> earlier() const { return earlier_; }

  private:
    std::vector<float> earlier_;
    std::vector<float> shown_;  ///< heights in the image under way
};

}  // namespace weft

#endif
