// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_SMOOTH_BALL_H
#define WEFT_SELFTEST_SMOOTH_BALL_H

#include <cstdint>
#include <vector>

#include "scene/scene.h"

// A ball of 80 facets with smooth normals under a directional light from the left, and what its
// image should show.
namespace weft::selftest {

inline constexpr std::uint32_t ball_width = 48;
inline constexpr std::uint32_t ball_height = 36;

struct SmoothBall {
    Scene scene;
    Camera camera;
};

[[nodiscard]] SmoothBall smooth_ball();

/// What a pixel's centre sees of the ball, by brute force in double precision. A convex body does
/// not shadow itself, so light ends only where facets turn away from it.
struct BallPixel {
    bool on_ball = false;
    bool facet_lit = false;  ///< the facet's plane faces the light
    double cosine = 0.0;     ///< of the smooth normal with the light, at least 0
    double radiance = 0.0;   ///< of direct light: 0 where either of them does not face it
    bool undecided = false;  ///< rounding may move the pixel to another facet or its light
};

/// All pixels, row by row from the top.
[[nodiscard]] const std::vector<BallPixel>& ball_pixels();

/// The largest cosine of the smooth normal at which a facet's plane faces away from the light: how
/// bright the blocks along the terminator would be.
[[nodiscard]] double largest_block();

}  // namespace weft::selftest

#endif
