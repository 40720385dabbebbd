// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_ROUGHNESS_H
#define WEFT_SCENE_SURFACE_ROUGHNESS_H

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/surface/surface_parameter.h"

namespace weft {

/// How a file states roughness.
enum class RoughnessScale : std::uint8_t {
    roughness,   ///< perceived roughness r, as glTF has it: alpha is r^2
    glossiness,  ///< g, as old glTF has it: alpha is (1 - g)^2
    alpha,       ///< alpha itself, as Mitsuba has it
    exponent,    ///< exponent n of a Phong lobe, as MTL files have it: alpha is sqrt(2 / (n + 2))
};

/// How rough a surface is, on the scale of its file.
struct Roughness {
    ScalarParameter value{};
    RoughnessScale scale = RoughnessScale::roughness;
};

/// The width alpha of the microfacets' slopes, 0 for a smooth surface, for a value on that scale.
[[nodiscard]] inline double alpha_of(double value, RoughnessScale scale) {
    const double share = std::clamp(value, 0.0, 1.0);
    switch (scale) {
        case RoughnessScale::roughness:
            return share * share;
        case RoughnessScale::glossiness:
            return (1.0 - share) * (1.0 - share);
        case RoughnessScale::alpha:
            return std::max(value, 0.0);
        case RoughnessScale::exponent:
            return std::sqrt(2.0 / (std::max(value, 0.0) + 2.0));
    }
    return 1.0;
}

/// The value on that scale for a width alpha of 0 to 1: the inverse of alpha_of. Exponents, which
/// would be endless for smooth surfaces, end at 10^8.
[[nodiscard]] inline double value_of(double alpha, RoughnessScale scale) {
    constexpr double most_exponent = 1e8;
    switch (scale) {
        case RoughnessScale::roughness:
            return std::sqrt(alpha);
        case RoughnessScale::glossiness:
            return 1.0 - std::sqrt(alpha);
        case RoughnessScale::alpha:
            return alpha;
        case RoughnessScale::exponent:
            return std::min(2.0 / (alpha * alpha) - 2.0, most_exponent);
    }
    return alpha;
}

/// Perceived roughness, 0 to 1, as glTF defines it: the root of alpha, without the texture.
[[nodiscard]] inline double perceived(const Roughness& roughness) {
    const auto value = static_cast<double>(roughness.value.factor);
    return std::min(std::sqrt(alpha_of(value, roughness.scale)), 1.0);
}

/// Changes it. Its texture stays, and so does the scale on which that multiplies.
inline void set_perceived(Roughness& roughness, double perceived) {
    roughness.value.factor = static_cast<float>(value_of(perceived * perceived, roughness.scale));
}

}  // namespace weft

#endif
