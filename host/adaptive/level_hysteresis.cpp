// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/level_hysteresis.h"

#include <algorithm>

namespace weft {
namespace {

constexpr std::array<Level, 2> raised_levels{Level::middle, Level::full};
constexpr std::array<std::uint8_t, 2> nothing_held{quiet_images, quiet_images};

}  // namespace

LevelHysteresis::LevelHysteresis(std::size_t tiles)
    : quiet_(tiles, nothing_held),
      verdict_{std::vector<Level>(tiles, Level::coarse), std::vector<Level>(tiles, Level::coarse)} {
}

void LevelHysteresis::begin_sequence() {
    std::fill(quiet_.begin(), quiet_.end(), nothing_held);
    clear_verdict();
}

void LevelHysteresis::begin_image() {
    // An image without a whole frame has no verdict.
    if (!judged_) return;
    for (std::size_t tile = 0; tile < quiet_.size(); ++tile)
        for (std::size_t i = 0; i < raised_levels.size(); ++i) {
            std::uint8_t& quiet = quiet_[tile][i];
            const bool held = quiet < quiet_images;
            if (verdict_.asked[tile] >= raised_levels[i] ||
                (held && verdict_.kept[tile] >= raised_levels[i])) {
                quiet = 0;
            } else if (held) {
                ++quiet;
            }
        }
    clear_verdict();
}

void LevelHysteresis::clear_verdict() {
    std::fill(verdict_.asked.begin(), verdict_.asked.end(), Level::coarse);
    std::fill(verdict_.kept.begin(), verdict_.kept.end(), Level::coarse);
    judged_ = false;
}

void LevelHysteresis::add(const LevelVerdict& frame) {
    for (std::size_t tile = 0; tile < quiet_.size(); ++tile) {
        verdict_.asked[tile] = std::max(verdict_.asked[tile], frame.asked[tile]);
        verdict_.kept[tile] = std::max(verdict_.kept[tile], frame.kept[tile]);
    }
    judged_ = true;
}

std::vector<Level> LevelHysteresis::held() const {
    std::vector<Level> levels;
    levels.reserve(quiet_.size());
    for (const Quiet& quiet : quiet_)
        levels.push_back(quiet[1] < quiet_images   ? Level::full
                         : quiet[0] < quiet_images ? Level::middle
                                                   : Level::coarse);
    return levels;
}

}  // namespace weft
