// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/noise_floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace weft::noise_floor_test {
namespace {

TradeoffResult result_of(const std::vector<double>& errors, double floor) {
    TradeoffResult result;
    result.measure = ErrorMeasure::vdp75;
    // Other measures must not count.
    result.reference.noise_floor.assign(error_measures, 1e9);
    result.reference.noise_floor[static_cast<std::size_t>(ErrorMeasure::vdp75)] = floor;
    for (const double error : errors) {
        TradeoffPoint point;
        point.name = "p" + std::to_string(result.points.size());
        point.errors.assign(error_measures, {5.0, 5.0, 5.0});
        point.errors[static_cast<std::size_t>(ErrorMeasure::vdp75)].median = error;
        result.points.push_back(point);
    }
    return result;
}

TEST(NoiseFloor, NamesTheSettingsThatItHides) {
    const TradeoffResult result = result_of({3.0, 0.5, 1.0, 1.001}, 1.0);
    EXPECT_FALSE(within_floor(result.points[0], result));
    EXPECT_TRUE(within_floor(result.points[1], result));
    EXPECT_TRUE(within_floor(result.points[2], result)) << "as large as the floor";
    EXPECT_FALSE(within_floor(result.points[3], result));
    EXPECT_EQ(points_within_floor(result).size(), 2U);
    EXPECT_EQ(floor_sentence(result),
              "Within the floor, HDR-VDP 75 % 1.00 %, where comparing says nothing: p1, p2.");
}

TEST(NoiseFloor, SaysSoWhereItHidesNone) {
    EXPECT_EQ(
        floor_sentence(result_of({3.0, 2.0}, 0.5)),
        "No setting is within the floor, HDR-VDP 75 % 0.500 %: the noise of the reference hides "
        "none.");
}

TEST(NoiseFloor, LongListsAreCut) {
    const std::string sentence = floor_sentence(result_of(std::vector<double>(11, 0.1), 0.5));
    EXPECT_NE(sentence.find("p6, p7 and 3 more."), std::string::npos) << sentence;
}

TEST(NoiseFloor, WithoutAFloorNothingIsWithin) {
    const TradeoffResult unknown = result_of({0.0}, std::nan(""));
    EXPECT_FALSE(within_floor(unknown.points[0], unknown));
    EXPECT_EQ(floor_sentence(unknown), "");
    EXPECT_EQ(floor_sentence(TradeoffResult{}), "");
    EXPECT_FALSE(within_floor(TradeoffPoint{}, result_of({}, 1.0)));
}

}  // namespace
}  // namespace weft::noise_floor_test
