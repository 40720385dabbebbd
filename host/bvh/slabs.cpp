// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/slabs.h"

#include <algorithm>

namespace weft {

Slabs::Slabs(const Box& box, std::size_t axis, std::size_t count) noexcept {
    origin_ = double{box.lower[axis]};
    const double size = double{box.upper[axis]} - origin_;
    if (!(size > 0.0)) return;
    for (std::size_t k = 1; k < count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        planes_[k] = static_cast<float>(origin_ + share * size);
        const float previous = k == 1 ? box.lower[axis] : planes_[k - 1];
        if (!(previous < planes_[k] && planes_[k] < box.upper[axis])) return;
    }
    scale_ = static_cast<double>(count) / size;
    count_ = count;
}

std::size_t Slabs::slab_of(float value) const noexcept {
    if (count_ == 1) return 0;
    const double place = (double{value} - origin_) * scale_;
    auto k = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count_ - 1)));
    // Planes are rounded to float, so the guess may be one off.
    while (k > 0 && value < planes_[k]) --k;
    while (k + 1 < count_ && value >= planes_[k + 1]) ++k;
    return k;
}

std::size_t Slabs::last_slab(std::size_t first, float upper) const noexcept {
    std::size_t k = slab_of(upper);
    while (k > first && upper <= planes_[k]) --k;
    return k;
}

}  // namespace weft
