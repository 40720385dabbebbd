// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/advice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace weft::advice_test {
namespace {

constexpr ErrorMeasure measure = ErrorMeasure::relmse;

TradeoffPoint point_of(const std::string& name, const Interval& ms, double error) {
    TradeoffPoint point;
    point.name = name;
    point.ms = ms;
    point.errors.assign(error_measures, Interval{1.0, 1.0, 1.0});
    point.errors[static_cast<std::size_t>(measure)] = {error, 0.9 * error, 1.1 * error};
    point.on_front = true;
    return point;
}

std::vector<TradeoffPoint> some_points() {
    return {point_of("fast", {50.0, 48.0, 52.0}, 0.4),
            point_of("steady", {280.0, 270.0, 290.0}, 0.1),
            point_of("unsteady", {290.0, 200.0, 400.0}, 0.05),
            point_of("slow", {2500.0, 2400.0, 2600.0}, 0.01)};
}

TEST(Advice, ABudgetGetsTheLeastErrorThatKeepsToIt) {
    const auto points = some_points();
    const TradeoffAdvice advice = advice_for_budget(points, measure, 300.0);
    // The better one may take 400 ms.
    EXPECT_EQ(advice.point, 1U);
    EXPECT_EQ(advice.budget_ms, 300.0);
    EXPECT_FALSE(advice.error);
    EXPECT_EQ(advice.preset_file, "preset-300ms.json");
    EXPECT_EQ(
        advice.sentence.find("for 300 ms the best is steady, with relMSE 0.1 (95 %: 0.09 to 0.11)"),
        0U)
        << advice.sentence;
    EXPECT_EQ(advice_for_budget(points, measure, 340.0).point, 2U);
    EXPECT_EQ(advice_for_budget(points, measure, 10e3).preset_file, "preset-10s.json");
    EXPECT_EQ(advice_for_budget(points, measure, 1234.0).preset_file, "preset-1.234s.json");
}

TEST(Advice, SaysWhereTheReferencesNoiseHidesWhatIsBetter) {
    const auto points = some_points();
    const auto noted = [&](double floor) {
        TradeoffAdvice advice = advice_for_budget(points, measure, 300.0);  // an error of 0.1
        const std::string before = advice.sentence;
        add_noise_note(advice, points, measure, floor);
        EXPECT_EQ(advice.sentence.find(before), 0U);
        return advice.sentence.substr(before.size());
    };
    EXPECT_EQ(noted(0.049), "");
    EXPECT_EQ(noted(std::nan("")), "");
    EXPECT_NE(noted(0.051).find("the reference's own noise, 0.051, hides"), std::string::npos);
    EXPECT_NE(noted(0.2).find("--reference-spp"), std::string::npos);
    TradeoffAdvice none = advice_for_budget(points, measure, 49.0);
    const std::string before = none.sentence;
    add_noise_note(none, points, measure, 1.0);
    EXPECT_EQ(none.sentence, before) << "nothing was chosen";
}

TEST(Advice, SaysWhatIsFastestWhereNothingIsFastEnough) {
    const TradeoffAdvice advice = advice_for_budget(some_points(), measure, 49.0);
    EXPECT_FALSE(advice.point);
    EXPECT_TRUE(advice.preset_file.empty());
    EXPECT_NE(advice.sentence.find("the fastest is fast"), std::string::npos) << advice.sentence;
}

TEST(Advice, AnErrorGetsTheCheapestThatReachesIt) {
    const auto points = some_points();
    const TradeoffAdvice advice = advice_for_error(points, measure, 0.1);
    EXPECT_EQ(advice.point, 1U);
    EXPECT_EQ(advice.error, 0.1);
    EXPECT_FALSE(advice.budget_ms);
    EXPECT_EQ(advice.preset_file, "preset-error-0.1.json");
    EXPECT_EQ(advice.sentence.find("for relMSE of at most 0.1 the cheapest is steady, in 280 ms"),
              0U)
        << advice.sentence;
    EXPECT_EQ(advice_for_error(points, measure, 0.09).point, 2U);
    const TradeoffAdvice none = advice_for_error(points, measure, 0.001);
    EXPECT_FALSE(none.point);
    EXPECT_NE(none.sentence.find("the best is slow"), std::string::npos) << none.sentence;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Advice, SaysWhatIsMissingWhereNothingIsCertainEnough) {
    const std::vector points{point_of("unsteady", {290.0, 200.0, 400.0}, 0.05)};
    const TradeoffAdvice advice = advice_for_budget(points, measure, 300.0);
    EXPECT_FALSE(advice.point);
    EXPECT_EQ(
        advice.sentence,
        "for 300 ms nothing that was measured is certain enough to keep to it: the fastest is "
        "unsteady, with relMSE 0.05 (95 %: 0.045 to 0.055), in 290 ms (95 %: 200 ms to 400 "
        "ms)");
}

TEST(Advice, NothingMeasuredIsNoAnswer) {
    const std::vector<TradeoffPoint> of_no_number{point_of("a", {1.0, 1.0, 1.0}, nan),
                                                  point_of("b", {nan, nan, nan}, 0.5),
                                                  point_of("c", {2.0, 2.0, 2.0}, infinity)};
    for (const std::vector<TradeoffPoint>& points : {std::vector<TradeoffPoint>{}, of_no_number}) {
        const TradeoffAdvice by_time = advice_for_budget(points, measure, 300.0);
        EXPECT_FALSE(by_time.point);
        EXPECT_TRUE(by_time.preset_file.empty());
        EXPECT_EQ(by_time.sentence,
                  "for 300 ms there is no answer: nothing that was measured has both a time and "
                  "relMSE");
        const TradeoffAdvice by_error = advice_for_error(points, measure, 0.25);
        EXPECT_FALSE(by_error.point);
        EXPECT_TRUE(by_error.preset_file.empty());
        EXPECT_EQ(by_error.sentence,
                  "for relMSE of at most 0.25 there is no answer: nothing that was measured has "
                  "both a time and relMSE");
        EXPECT_TRUE(sensible_errors(points, measure).empty());
    }
}

TEST(Advice, WhatIsNoNumberIsPassedOver) {
    // First, where comparing with it would keep it.
    std::vector<TradeoffPoint> points{point_of("none", {40.0, 40.0, 40.0}, nan)};
    for (TradeoffPoint& point : some_points()) points.push_back(std::move(point));
    EXPECT_EQ(advice_for_budget(points, measure, 300.0).point, 2U);
    EXPECT_EQ(advice_for_error(points, measure, 0.1).point, 2U);
    EXPECT_NE(advice_for_budget(points, measure, 30.0).sentence.find("the fastest is fast"),
              std::string::npos);
    EXPECT_NE(advice_for_error(points, measure, 0.001).sentence.find("the best is slow"),
              std::string::npos);
    EXPECT_EQ(sensible_errors(points, measure), sensible_errors(some_points(), measure));
}

TEST(Advice, OfOnePointIsThatPoint) {
    const std::vector points{point_of("only", {50.0, 48.0, 52.0}, 0.4)};
    EXPECT_EQ(advice_for_budget(points, measure, 50.0).point, 0U);
    EXPECT_EQ(advice_for_error(points, measure, 0.4).point, 0U);
    EXPECT_NE(advice_for_budget(points, measure, 10.0).sentence.find("the fastest is only"),
              std::string::npos);
    EXPECT_NE(advice_for_error(points, measure, 0.1).sentence.find("the best is only"),
              std::string::npos);
}

TEST(Advice, OfEqualErrorsTheFastestAndOfEqualTimesTheNearest) {
    const Interval slow{80.0, 80.0, 80.0};
    const Interval quick{20.0, 20.0, 20.0};
    const std::vector equal_errors{point_of("slow", slow, 0.5), point_of("quick", quick, 0.5),
                                   point_of("slow too", slow, 0.5)};
    EXPECT_EQ(advice_for_budget(equal_errors, measure, 100.0).point, 1U);
    EXPECT_EQ(advice_for_error(equal_errors, measure, 0.5).point, 1U);
    EXPECT_NE(advice_for_error(equal_errors, measure, 0.1).sentence.find("the best is quick"),
              std::string::npos);
    const std::vector equal_times{point_of("far", quick, 0.5), point_of("near", quick, 0.25)};
    EXPECT_EQ(advice_for_error(equal_times, measure, 0.5).point, 1U);
    EXPECT_NE(advice_for_budget(equal_times, measure, 10.0).sentence.find("the fastest is near"),
              std::string::npos);
}

TEST(Advice, TimesReadWell) {
    EXPECT_EQ(time_text(3.14159), "3.14 ms");
    EXPECT_EQ(time_text(999.4), "999 ms");
    EXPECT_EQ(time_text(999.6), "1 s");
    EXPECT_EQ(time_text(2500.0), "2.5 s");
    EXPECT_EQ(time_text(1e6), "1000 s");
    EXPECT_EQ(time_text(12345e3), "12345 s");
}

TEST(Advice, SensibleErrorsLieWithinTheFront) {
    auto points = some_points();
    points.push_back(point_of("beaten", {9e3, 8e3, 1e4}, 7.0));
    points.back().on_front = false;
    const std::vector<double> errors = sensible_errors(points, measure);
    ASSERT_EQ(errors.size(), 3U);
    for (const double error : errors) {
        EXPECT_GT(error, 0.01);
        EXPECT_LT(error, 0.4);
        EXPECT_TRUE(advice_for_error(points, measure, error).point);
    }
    // 0.01 to 0.4 is a factor of 40, of which the middle is the root.
    EXPECT_NEAR(errors[1], 0.01 * std::sqrt(40.0), 0.0005 + 1e-12);
    EXPECT_TRUE(std::is_sorted(errors.rbegin(), errors.rend()));
}

TEST(Advice, NoErrorsWhereThereIsNoRange) {
    EXPECT_TRUE(
        sensible_errors(std::vector{point_of("only", {1.0, 1.0, 1.0}, 0.5)}, measure).empty());
    EXPECT_TRUE(sensible_errors(std::vector{point_of("a", {1.0, 1.0, 1.0}, 0.0),
                                            point_of("b", {2.0, 2.0, 2.0}, 0.0)},
                                measure)
                    .empty());
    // All that rounding to two digits leaves between the two is nothing.
    const std::vector<double> close = sensible_errors(
        std::vector{point_of("a", {1.0, 1.0, 1.0}, 0.5012), point_of("b", {2.0, 2.0, 2.0}, 0.5011)},
        measure);
    EXPECT_TRUE(close.empty());
}

}  // namespace
}  // namespace weft::advice_test
