// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_SRGB_H
#define WEFT_BASE_SRGB_H

#include <cmath>
#include <concepts>
#include <glm/glm.hpp>

namespace weft {

/// The linear value of an sRGB encoded one, both in [0, 1] (IEC 61966-2-1).
template <std::floating_point T>
[[nodiscard]] T linear_from_srgb(T value) {
    constexpr auto linear_end = static_cast<T>(0.04045);
    constexpr auto slope = static_cast<T>(12.92);
    constexpr auto offset = static_cast<T>(0.055);
    constexpr auto scale = static_cast<T>(1.055);
    constexpr auto exponent = static_cast<T>(2.4);
    return value <= linear_end ? value / slope : std::pow((value + offset) / scale, exponent);
}

/// The same for each channel of a colour.
[[nodiscard]] inline glm::vec3 linear_from_srgb(const glm::vec3& colour) {
    return {linear_from_srgb(colour.r), linear_from_srgb(colour.g), linear_from_srgb(colour.b)};
}

/// The inverse of linear_from_srgb.
[[nodiscard]] inline double srgb_from_linear(double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

}  // namespace weft

#endif
