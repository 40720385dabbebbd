// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "selftest/smooth_ball.h"

// What `weft selftest` expects of a coarse smooth ball, by what is known of any.
namespace weft::selftest_ball_test {
namespace {

using selftest::BallPixel;

const BallPixel& pixel_at(std::size_t x, std::size_t y) {
    return selftest::ball_pixels().at(y * selftest::ball_width + x);
}

TEST(SelftestBall, FillsTheDiskThatItsRadiusSpans) {
    // From a distance of 3 the unit sphere has the angular radius asin(1/3). A coarse ball reaches
    // as far at its vertices, and at least to the plane of a facet, 0.93 radii from the middle.
    const double per_pixel = 2.0 * std::tan(0.45) / selftest::ball_height;
    std::size_t on_ball = 0;
    for (const BallPixel& pixel : selftest::ball_pixels()) on_ball += pixel.on_ball ? 1 : 0;
    const auto pixels_of = [&](double radius) {
        const double reach = std::tan(std::asin(radius / 3.0)) / per_pixel;
        return std::numbers::pi * reach * reach;
    };
    EXPECT_LT(static_cast<double>(on_ball), pixels_of(1.0));
    EXPECT_GT(static_cast<double>(on_ball), pixels_of(0.93));
    EXPECT_TRUE(pixel_at(24, 18).on_ball);
    EXPECT_FALSE(pixel_at(0, 0).on_ball);
}

TEST(SelftestBall, IsLitWhereNormalsAndFacetsFaceTheLight) {
    std::size_t lit = 0;
    for (std::size_t i = 0; i < selftest::ball_pixels().size(); ++i) {
        const BallPixel& pixel = selftest::ball_pixels()[i];
        EXPECT_EQ(pixel.radiance > 0.0, pixel.facet_lit && pixel.cosine > 0.0);
        EXPECT_LE(pixel.radiance, 0.5 / std::numbers::pi);
        if (!(pixel.radiance > 0.0)) continue;
        ++lit;
        // Light comes from the left, and a little from behind the ball.
        EXPECT_LT(i % selftest::ball_width, selftest::ball_width / 2) << i;
    }
    EXPECT_GT(lit, 100U);
}

TEST(SelftestBall, BlocksAreAsHighAsFacetsLeanAgainstNormalsAtMost) {
    // Of an icosahedron whose faces are quartered no normal of a vertex leans by more than 21
    // degrees against its facets: of the smooth normal in between, the sine is less than 0.36.
    EXPECT_GT(selftest::largest_block(), 0.1);
    EXPECT_LT(selftest::largest_block(), 0.36);
}

}  // namespace
}  // namespace weft::selftest_ball_test
