// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_SRGB_H
#define WEFT_IMAGE_SRGB_H

#include <cmath>
#include <glm/glm.hpp>

namespace weft {

/// The linear value of an sRGB encoded one, both in [0, 1] (IEC 61966-2-1).
[[nodiscard]] inline float linear_from_srgb(float value) {
    return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

/// The same for each channel of a colour.
[[nodiscard]] inline glm::vec3 linear_from_srgb(const glm::vec3& colour) {
    return {linear_from_srgb(colour.r), linear_from_srgb(colour.g), linear_from_srgb(colour.b)};
}

}  // namespace weft

#endif
