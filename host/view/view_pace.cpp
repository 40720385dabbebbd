// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_pace.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr std::uint32_t most_divisor = 16;
constexpr std::uint32_t least_edge = 128;
// A single quick image may show a wall in front of the camera.
constexpr std::uint32_t quick_enough = 4;

}  // namespace

FilmSize ViewPace::divided(std::uint32_t divisor) const {
    const auto part = [&](std::uint32_t edge) {
        return std::max(1U, (edge + divisor - 1) / divisor);
    };
    return {part(full_.width), part(full_.height)};
}

void ViewPace::set_full(FilmSize full) {
    // Small images are as quick whatever they are parts of.
    const double growth = timed_ ? static_cast<double>(std::max(full.width, full.height)) /
                                       std::max(full_.width, full_.height)
                                 : 1.0;
    full_ = full;
    divide_by(static_cast<std::uint32_t>(
        std::clamp(std::ceil(divisor_ * growth), 1.0, double{most_divisor})));
}

void ViewPace::divide_by(std::uint32_t divisor) {
    divisor_ = std::min(divisor, most_divisor);
    while (divisor_ > 1 && std::max(size().width, size().height) < least_edge) --divisor_;
    quick_ = 0;
}

void ViewPace::took_full(double ms) {
    if (timed_ || !(ms > 0.0)) return;
    const double wanted = std::ceil(std::sqrt(ms / aim_ms));
    divide_by(static_cast<std::uint32_t>(std::clamp(wanted, 1.0, double{most_divisor})));
}

void ViewPace::took(double ms) {
    timed_ = true;
    // The time goes with the number of pixels; the part of it that does not makes the next guess a
    // little too careful.
    if (ms > most_ms) {
        const double wanted = std::ceil(divisor_ * std::sqrt(ms / aim_ms));
        divide_by(static_cast<std::uint32_t>(
            std::clamp(wanted, static_cast<double>(divisor_), double{most_divisor})));
        return;
    }
    const double growth = divisor_ > 1 ? static_cast<double>(divisor_) / (divisor_ - 1) : 0.0;
    quick_ = divisor_ > 1 && ms * growth * growth < aim_ms ? quick_ + 1 : 0;
    if (quick_ < quick_enough) return;
    --divisor_;
    quick_ = 0;
}

}  // namespace weft
