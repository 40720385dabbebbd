// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::tone_test {
namespace {

constexpr ToneCurve curves[] = {ToneCurve::filmic, ToneCurve::agx};

float spread(const glm::vec3& colour) {
    return std::max({colour.r, colour.g, colour.b}) - std::min({colour.r, colour.g, colour.b});
}

TEST(Tone, NoneLeavesColoursAsTheyAre) {
    const glm::vec3 colour(-3.0F, 0.25F, 1e20F);
    EXPECT_EQ(toned(ToneCurve::none, colour), colour);
}

TEST(Tone, BlackStaysBlackAndBrightGreyBecomesWhite) {
    for (const ToneCurve curve : curves) {
        EXPECT_EQ(toned(curve, glm::vec3(0.0F)), glm::vec3(0.0F));
        // The fit of AgX ends 0.3 % below white.
        for (const float bright : {32.0F, 1e6F, 1e30F})
            EXPECT_NEAR(toned(curve, glm::vec3(bright)).g, 1.0F, 0.0035F) << bright;
    }
}

TEST(Tone, GreyStaysGreyAndRises) {
    for (const ToneCurve curve : curves) {
        float before = 0.0F;
        for (int step = 0; step <= 4000; ++step) {
            // From 2^-12 to 2^4, where both curves are not flat yet, or nearly so.
            const float grey = std::exp2(-12.0F + 16.0F * static_cast<float>(step) / 4000.0F);
            const glm::vec3 shown = toned(curve, glm::vec3(grey));
            EXPECT_LT(spread(shown), 2e-5F) << grey;
            EXPECT_GE(shown.g, before) << grey;
            if (step % 100 == 0 && grey < 7.0F) {
                EXPECT_GT(shown.g, before) << grey;
            }
            before = shown.g;
        }
    }
}

TEST(Tone, FilmicHasThePublishedValues) {
    // x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) in exact arithmetic.
    EXPECT_NEAR(toned(ToneCurve::filmic, glm::vec3(0.18F)).r, 0.266899, 1e-5);
    EXPECT_NEAR(toned(ToneCurve::filmic, glm::vec3(1.0F)).r, 2.54 / 3.16, 1e-6);
    EXPECT_EQ(toned(ToneCurve::filmic, glm::vec3(7.3F)).r, 1.0F);
    EXPECT_LT(toned(ToneCurve::filmic, glm::vec3(7.2F)).r, 1.0F);
    // By channel.
    const glm::vec3 mixed = toned(ToneCurve::filmic, {1.0F, 0.18F, 0.0F});
    EXPECT_NEAR(mixed.r, 2.54 / 3.16, 1e-6);
    EXPECT_NEAR(mixed.g, 0.266899, 1e-5);
    EXPECT_EQ(mixed.b, 0.0F);
}

TEST(Tone, AgxPutsMiddleGreyInTheMiddleOfTheCodes) {
    // Its curve turns about 0.18, which becomes the code 0.5 of a display of gamma 2.2, to the
    // published error of the fit (0.002 on average).
    const float middle = toned(ToneCurve::agx, glm::vec3(0.18F)).g;
    EXPECT_NEAR(std::pow(middle, 1.0F / 2.2F), 0.5F, 0.004F);
    // And 6.5 stops above it is where it ends.
    EXPECT_LT(toned(ToneCurve::agx, glm::vec3(0.18F * std::exp2(5.0F))).g, 0.985F);
}

TEST(Tone, AgxTurnsBrightSaturatedLightWhite) {
    for (int channel = 0; channel < 3; ++channel) {
        glm::vec3 pure(0.0F);
        pure[channel] = 1.0F;
        float before = 1.0F;
        for (const float exposure : {0.5F, 4.0F, 32.0F, 256.0F, 2048.0F}) {
            const glm::vec3 shown = toned(ToneCurve::agx, pure * exposure);
            const float saturation = spread(shown) / std::max({shown.r, shown.g, shown.b});
            EXPECT_LE(saturation, before) << "channel " << channel << " at " << exposure;
            before = saturation;
        }
        EXPECT_LT(before, 0.05F) << "channel " << channel;
        // A curve by channel keeps it as it is.
        const glm::vec3 kept = toned(ToneCurve::filmic, pure * 2048.0F);
        EXPECT_EQ(spread(kept), 1.0F);
    }
}

TEST(Tone, WhateverComesInSomethingThatCanBeShownGoesOut) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float values[] = {-infinity, -1e30F, -1.0F, -1e-40F, 0.0F,     1e-40F,
                                1e-6F,     1.0F,   1e6F,  1e30F,   infinity, nan};
    for (const ToneCurve curve : curves)
        for (const float r : values)
            for (const float g : values)
                for (const float b : values) {
                    const glm::vec3 shown = toned(curve, {r, g, b});
                    for (int c = 0; c < 3; ++c)
                        EXPECT_TRUE(shown[c] >= 0.0F && shown[c] <= 1.0F)
                            << r << " " << g << " " << b << " gave " << shown[c];
                }
    // What cannot be is black.
    EXPECT_EQ(toned(ToneCurve::agx, glm::vec3(-5.0F)), glm::vec3(0.0F));
    EXPECT_EQ(toned(ToneCurve::filmic, glm::vec3(nan)), glm::vec3(0.0F));
}

}  // namespace
}  // namespace weft::tone_test
