// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/light_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace weft {

bool is_dark(const std::vector<LightShare>& light) {
    return !light.empty() && std::all_of(light.begin(), light.end(), [](const LightShare& part) {
        return !(part.share > 0.0);
    });
}

std::string light_text(const std::vector<LightShare>& light) {
    std::string text;
    for (const LightShare& part : light)
        text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", part.component,
                            std::floor(100.0 * part.share));
    return text;
}

void LightWork::plan(Stage stage, const char* component, std::uint32_t items) {
    if (component_.empty()) component_ = component;
    if (!brings_light(stage)) return;
    const auto found = std::find_if(parts_.begin(), parts_.end(),
                                    [&](const Part& part) { return part.stage == stage; });
    if (found == parts_.end())
        parts_.push_back({stage, static_cast<double>(items), 0.0});
    else if (found->done < found->planned)
        found->planned += items;
    // Else the stage has lit every pixel, and what it runs from now on refines that.
}

void LightWork::add(Stage stage, double items) {
    for (Part& part : parts_)
        if (part.stage == stage) part.done += items;
}

double LightWork::share() const {
    if (parts_.empty()) return 1.0;
    double sum = 0.0;
    for (const Part& part : parts_) sum += std::min(1.0, part.done / part.planned);
    return sum / static_cast<double>(parts_.size());
}

}  // namespace weft
