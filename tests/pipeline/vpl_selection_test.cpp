// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/vpl_selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

// The choice of VPLs for the camera, by its definition.
namespace weft::vpl_selection_test {
namespace {

shared::Vpl vpl_at(float x, float y, float z, float flux) {
    shared::Vpl vpl{};
    vpl.position = {x, y, z, 3.0F};
    vpl.normal = {0.0F, 0.0F, 1.0F, 0.0F};
    vpl.flux = {flux, flux, flux, 0.5F};
    return vpl;
}

std::vector<shared::Vpl> random_vpls(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<shared::Vpl> vpls;
    for (std::size_t i = 0; i < count; ++i) {
        const float x = uniform(random);
        const float y = uniform(random);
        const float z = uniform(random);
        vpls.push_back(vpl_at(x, y, z, i % 7 == 3 ? 0.0F : uniform(random)));
    }
    return vpls;
}

std::vector<float> random_contributions(const std::vector<shared::Vpl>& vpls, std::size_t points,
                                        std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<float> contributions;
    for (const shared::Vpl& vpl : vpls)
        for (std::size_t k = 0; k < points; ++k)
            contributions.push_back(uniform(random) < 0.6F ? 0.0F : uniform(random) * vpl.flux.x);
    return contributions;
}

TEST(VplSelection, ProbabilitiesAreSharesOfLightAndOfFlux) {
    const std::vector<shared::Vpl> vpls{vpl_at(0, 0, 0, 1.0F), vpl_at(1, 0, 0, 3.0F),
                                        vpl_at(0, 1, 0, 4.0F)};
    // Two points, of which the second is four times as bright; the third VPL reaches neither.
    const std::vector<float> contributions{1.0F, 1.0F, 0.0F, 3.0F, 0.0F, 0.0F};
    // Their light is 1 and 4, to which a tenth of the mean, 2.5, is added.
    const double first = 1.0 / 1.25 + 1.0 / 4.25;
    const double second = 3.0 / 4.25;
    const auto found = choice_probabilities({vpls, contributions}, 0.25);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_NEAR(found[0], 0.75 * first / (first + second) + 0.25 / 8.0, 1e-6);
    EXPECT_NEAR(found[1], 0.75 * second / (first + second) + 0.25 * 3.0 / 8.0, 1e-6);
    EXPECT_NEAR(found[2], 0.25 * 4.0 / 8.0, 1e-6);
}

TEST(VplSelection, WhereThePointsTellNothingFluxDecides) {
    const std::vector<shared::Vpl> vpls{vpl_at(0, 0, 0, 1.0F), vpl_at(1, 0, 0, 3.0F)};
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const std::vector<float>& contributions :
         {std::vector<float>(4, 0.0F), std::vector<float>{infinity, 0.0F, 1.0F, 1.0F},
          std::vector<float>{std::numeric_limits<float>::quiet_NaN(), 0.0F, 1.0F, 1.0F}}) {
        const auto found = choice_probabilities({vpls, contributions}, 0.25);
        EXPECT_DOUBLE_EQ(found[0], 0.25);
        EXPECT_DOUBLE_EQ(found[1], 0.75);
    }
    const std::vector<shared::Vpl> dark{vpl_at(0, 0, 0, 0.0F), vpl_at(1, 0, 0, 0.0F)};
    const auto chosen = select_vpls({dark, std::vector<float>(4, 0.0F)}, 5, 0.3, 0.1);
    ASSERT_EQ(chosen.size(), 5U);
    for (const shared::Vpl& vpl : chosen) EXPECT_EQ(vpl.flux.x, 0.0F);
}

/// The mean over all starts of what the chosen VPLs have in some function of their places is that
/// of all candidates: no light is lost or won.
TEST(VplSelection, KeepsTheLightOfAllCandidates) {
    constexpr std::uint32_t starts = 4096;
    const std::vector<shared::Vpl> vpls = random_vpls(150, 5);
    const std::vector<float> contributions = random_contributions(vpls, 16, 6);
    const auto brightness = [](const shared::Vpl& vpl) {
        return static_cast<double>(vpl.flux.x) * (1.0 + std::sin(20.0 * vpl.position.x));
    };
    double expected = 0.0;
    for (const shared::Vpl& vpl : vpls) expected += brightness(vpl);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < starts; ++i) {
        const auto chosen = select_vpls({vpls, contributions}, 24, (i + 0.5) / starts, 0.0);
        ASSERT_EQ(chosen.size(), 24U);
        for (const shared::Vpl& vpl : chosen) sum += brightness(vpl);
    }
    // Each of the 150 VPLs begins and ends to be chosen at some start, between two of the 4096.
    EXPECT_NEAR(sum / starts, expected, 0.005 * expected);
}

/// What the points see varies less from choice to choice than by choices that go by flux.
TEST(VplSelection, IsMoreEvenThanByFlux) {
    constexpr std::uint32_t starts = 256;
    constexpr std::size_t points = 16;
    const std::vector<shared::Vpl> vpls = random_vpls(300, 8);
    // The points see what lies in one corner.
    std::vector<float> contributions;
    for (const shared::Vpl& vpl : vpls)
        contributions.insert(contributions.end(), points,
                             vpl.position.x < 0.2F && vpl.position.y < 0.5F ? vpl.flux.x : 0.0F);
    const auto variance = [&](const std::vector<float>& known) {
        double sum = 0.0;
        double squares = 0.0;
        for (std::uint32_t i = 0; i < starts; ++i) {
            double light = 0.0;
            for (const shared::Vpl& vpl : select_vpls({vpls, known}, 24, (i + 0.5) / starts, 0.0))
                if (vpl.position.x < 0.2F && vpl.position.y < 0.5F)
                    light += static_cast<double>(vpl.flux.x);
            sum += light;
            squares += light * light;
        }
        return squares / starts - (sum / starts) * (sum / starts);
    };
    EXPECT_LT(variance(contributions),
              0.1 * variance(std::vector<float>(contributions.size(), 0.0F)));
}

TEST(VplSelection, KeepsPlacesBoundsAndOrderOfRouletteNumbers) {
    const std::vector<shared::Vpl> vpls = random_vpls(150, 9);
    const std::vector<float> contributions = random_contributions(vpls, 16, 10);
    const auto chosen = select_vpls({vpls, contributions}, 24, 0.5, 0.25);
    std::vector<int> quarters(4, 0);
    for (const shared::Vpl& vpl : chosen) {
        if (!(vpl.flux.x > 0.0F)) continue;
        EXPECT_EQ(vpl.position.w, 3.0F);
        EXPECT_GT(vpl.flux.w, 0.0F);
        EXPECT_LE(vpl.flux.w, 1.0F);
        ++quarters[static_cast<std::size_t>(std::min(3.0F, vpl.flux.w * 4.0F))];
    }
    for (const int count : quarters) EXPECT_NEAR(count, 6, 2);
}

TEST(VplSelection, AVplThatIsChosenTwiceIsOneOfAllItsFlux) {
    const std::vector<shared::Vpl> vpls{vpl_at(0, 0, 0, 1.0F), vpl_at(1, 0, 0, 2.0F)};
    const auto chosen = select_vpls({vpls, std::vector<float>(4, 0.0F)}, 30, 0.5, 0.0);
    double sum = 0.0;
    int lit = 0;
    for (const shared::Vpl& vpl : chosen) {
        sum += static_cast<double>(vpl.flux.x);
        if (vpl.flux.x > 0.0F) ++lit;
    }
    EXPECT_EQ(chosen.size(), 30U);
    EXPECT_EQ(lit, 2);
    EXPECT_NEAR(sum, 3.0, 1e-6);
}

}  // namespace
}  // namespace weft::vpl_selection_test
