// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_OVERLAY_H
#define WEFT_VIEW_VIEW_OVERLAY_H

#include <span>
#include <string>
#include <vector>

#include "image/image.h"

namespace weft {

/// The overlay of how far an image is from its reference.
inline constexpr const char* error_overlay_name = "error";

/// The names of the overlays of an image: its layers of levels, samples and errors, and
/// error_overlay_name where it was `judged`.
[[nodiscard]] std::vector<std::string> overlay_names(const Image& image, bool judged);

/// Shows an overlay on its image: see value_overlay. `flip`: HDR-FLIP by pixel, row-major, or empty
/// where the image was not judged. Returns an image without layers where there is no such overlay.
[[nodiscard]] Image overlay_of(const Image& image, const std::string& name,
                               std::span<const float> flip, double exposure_ev);

}  // namespace weft

#endif
