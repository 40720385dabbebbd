// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/session_stats.h"

#include <utility>

namespace weft {

const char* film_component_name(std::size_t component) {
    // In the order of COMPONENT_*.
    static constexpr std::array<const char*, COMPONENT_COUNT> names{
        "emission", "direct", "indirect", "surface", "media", "reflection", "refraction", "glossy"};
    return names[component];
}

void SessionStats::add(std::vector<FrameStats> frames) {
    for (FrameStats& frame : frames) {
        frame.image += first_image_;
        sample_ = frame.image == image_ ? sample_ : 0;
        image_ = frame.image;
        add_nonfinite(frame);
        ++sample_;
        ++count_;
        ms_ += frame.ms;
        rays_ += frame.rays;
        frames_.push_back(std::move(frame));
        if (frames_.size() > kept_) frames_.pop_front();
    }
}

void SessionStats::add_nonfinite(const FrameStats& frame) {
    for (std::size_t c = 0; c < nonfinite_.size(); ++c) {
        const NonfiniteStats& found = frame.nonfinite[c];
        NonfiniteSummary& sum = nonfinite_[c];
        if (sum.count == 0 && found.count > 0) {
            sum.component = film_component_name(c);
            sum.first_image = frame.image;
            sum.first_sample = sample_;
            sum.first_pixel = found.first_pixel;
        }
        sum.count += found.count;
    }
}

void SessionStats::begin_renderer() {
    first_image_ = count_ > 0 ? image_ + 1 : 0;
}

std::vector<NonfiniteSummary> SessionStats::nonfinite() const {
    std::vector<NonfiniteSummary> found;
    for (const NonfiniteSummary& sum : nonfinite_)
        if (sum.count > 0) found.push_back(sum);
    return found;
}

}  // namespace weft
