// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_overlay.h"

#include <algorithm>
#include <optional>

#include "adaptive/level_overlay.h"

namespace weft {

std::vector<std::string> overlay_names(const Image& image, bool judged) {
    std::vector<std::string> names = overlay_layers(image);
    if (judged) names.emplace_back(error_overlay_name);
    return names;
}

Image overlay_of(const Image& image, const std::string& name, std::span<const float> flip,
                 double exposure_ev) {
    const bool judged = flip.size() == std::size_t{image.width} * image.height;
    const std::vector<std::string> names = overlay_names(image, judged);
    if (std::ranges::find(names, name) == names.end()) return {};
    if (name != error_overlay_name) return level_overlay(image, name, exposure_ev);
    return value_overlay(
        image, [&](std::size_t pixel) { return std::optional<double>(flip[pixel]); }, exposure_ev);
}

}  // namespace weft
