// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/level_fade.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {

Level level_below(float height) {
    return static_cast<Level>(std::floor(height));
}

Level level_above(float height) {
    return static_cast<Level>(std::ceil(height));
}

float faded_height(float earlier, Level wanted) {
    return std::max(height_of(wanted), earlier - fade_step);
}

void LevelFade::begin_sequence() {
    earlier_.clear();
    shown_.clear();
}

void LevelFade::begin_image() {
    // An image without a whole frame has no heights to fade from.
    if (!shown_.empty()) earlier_ = std::exchange(shown_, {});
}

void LevelFade::show(std::vector<float> heights) {
    shown_ = std::move(heights);
}

}  // namespace weft
