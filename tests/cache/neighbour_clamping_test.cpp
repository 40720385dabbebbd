// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/neighbour_clamping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace weft::neighbour_clamping_test {
namespace {

using Places = std::vector<shared::float4>;

double distance(const shared::float4& a, const shared::float4& b) {
    const double x = double{a.x} - double{b.x};
    const double y = double{a.y} - double{b.y};
    const double z = double{a.z} - double{b.z};
    return std::sqrt(x * x + y * y + z * z);
}

/// Records in clumps, as rounds place them, radii over six orders of magnitude.
Places random_places(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    Places places;
    shared::float4 centre{};
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 37 == 0) centre = {uniform(random), uniform(random), uniform(random), 0.0F};
        const float spread = 0.1F;
        const float x = centre.x + spread * uniform(random);
        const float y = centre.y + spread * uniform(random);
        const float z = centre.z + spread * uniform(random);
        places.push_back({x, y, z, std::pow(10.0F, 3.0F * uniform(random) - 3.0F)});
    }
    return places;
}

/// Every pair.
std::vector<float> brute_force(const Places& places, double slope) {
    std::vector<float> radii;
    for (const shared::float4& place : places) {
        double radius = place.w;
        for (const shared::float4& other : places)
            radius = std::min(radius, double{other.w} + slope * distance(place, other));
        radii.push_back(static_cast<float>(radius));
    }
    return radii;
}

TEST(NeighbourClamping, IsTheSmallestRadiusThatAnyNeighbourAllows) {
    for (const std::size_t count : {0UL, 1UL, 2UL, 7UL, 8UL, 9UL, 64UL, 65UL, 1000UL})
        for (const double slope : {0.0, 0.1, 1.0, 30.0}) {
            const Places places = random_places(count, static_cast<std::uint32_t>(count));
            EXPECT_EQ(neighbour_clamped(places, slope), brute_force(places, slope))
                << count << " records, slope " << slope;
        }
}

TEST(NeighbourClamping, DoesNotDependOnTheOrder) {
    const Places places = random_places(700, 3);
    const std::vector<float> radii = neighbour_clamped(places, 0.2);
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), std::mt19937(4));
    Places shuffled;
    for (const std::size_t i : order) shuffled.push_back(places[i]);
    const std::vector<float> other = neighbour_clamped(shuffled, 0.2);
    for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(other[i], radii[order[i]]);
}

TEST(NeighbourClamping, RadiiChangeByTheSlopeAtMostAndASecondTimeByNothing) {
    constexpr double slope = 0.25;
    Places places = random_places(500, 5);
    const std::vector<float> radii = neighbour_clamped(places, slope);
    std::size_t clamped = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_LE(radii[i], places[i].w);
        clamped += radii[i] < places[i].w ? 1 : 0;
        for (std::size_t k = 0; k < places.size(); ++k)
            // Radii are rounded to floats.
            EXPECT_LE(double{radii[i]},
                      (double{radii[k]} + slope * distance(places[i], places[k])) * (1.0 + 2e-7));
    }
    EXPECT_GT(clamped, places.size() / 10);
    EXPECT_LT(clamped, places.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i].w = radii[i];
    const std::vector<float> again = neighbour_clamped(places, slope);
    for (std::size_t i = 0; i < places.size(); ++i)
        EXPECT_NEAR(again[i], radii[i], 2e-7F * radii[i]);
}

TEST(NeighbourClamping, FindsWhatOthersHaveMet) {
    // A thin post that the rays of one record alone have met, between two that missed it.
    const Places places{{0, 0, 0, 5.0F}, {1, 0, 0, 0.1F}, {2, 0, 0, 0.5F}, {9, 0, 0, 4.0F}};
    const std::vector<float> radii = neighbour_clamped(places, 1.0);
    EXPECT_FLOAT_EQ(radii[0], 1.1F);
    EXPECT_EQ(radii[1], 0.1F);
    EXPECT_EQ(radii[2], 0.5F);
    EXPECT_EQ(radii[3], 4.0F);
}

}  // namespace
}  // namespace weft::neighbour_clamping_test
