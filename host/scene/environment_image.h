// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_ENVIRONMENT_IMAGE_H
#define WEFT_SCENE_ENVIRONMENT_IMAGE_H

#include <cstdint>
#include <string>
#include <vector>

namespace weft {

/// The radiance that comes from each direction, in equirectangular projection: the image's width
/// goes once around its axis +y, its height from +y down to -y. A direction (x, y, z) has the
/// coordinates u = 1/2 + atan2(z, x) / 2 pi and v = acos(y) / pi.
struct EnvironmentImage {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> radiance{};  ///< rgb, row-major, top row first; linear, not negative
    /// Whether the first and the last row lie on the poles; else all rows are of the same height,
    /// and the poles are half a row beyond. The first column begins at u = 0 in both.
    bool rows_at_poles = false;
};

}  // namespace weft

#endif
