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

/// Share of the threshold below which an error no longer holds the level that it once required.
inline constexpr double release_share = 0.7;

/// Images in a row of such errors for which a tile keeps its level.
inline constexpr std::uint32_t quiet_images = 4;

/// The levels that the errors of one frame require of every tile; coarse where they require none,
/// or where geometry and shadows already require as much.
struct LevelVerdict {
    std::vector<Level> asked;  ///< required at the threshold
    std::vector<Level> kept;   ///< required at release_share of the threshold; at least `asked`
};

/// Keeps a tile whose error wavers about the threshold from changing its level from image to image
/// of a sequence. A level that an error required is held until the error was below release_share
/// of the threshold in quiet_images images in a row. Levels rise without delay, and those that
/// geometry or shadows require are not held: they follow each image.
class LevelHysteresis {
  public:
    explicit LevelHysteresis(std::size_t tiles);

    /// Forgets all: the next image is the first of a sequence.
    void begin_sequence();
    /// The next image of the sequence.
    void begin_image();

    /// Adds the verdict of a frame of the image. An image's verdict is the highest of those of its
    /// frames.
    void add(const LevelVerdict& frame);

    /// The level that earlier images of the sequence hold each tile at; coarse where none does.
    /// The same for all frames of an image.
    [[nodiscard]] std::vector<Level> held() const;

  private:
    /// For the middle and the full level: the number of images in a row since errors required at
    /// least that level. At quiet_images, the largest value, the level is not held.
    using Quiet = std::array<std::uint8_t, 2>;

    void clear_verdict();

    std::vector<Quiet> quiet_;
    LevelVerdict verdict_;  ///< of the image under way
    bool judged_ = false;   ///< whether verdict_ has that of any frame
};

}  // namespace weft

#endif
