// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_front.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace weft::view_front_test {
namespace {

ViewFront three_points() {
    std::vector<ViewCandidate> candidates(3);
    for (std::size_t i = 0; i < candidates.size(); ++i)
        candidates[i].name = "setting " + std::to_string(i);
    return ViewFront(std::move(candidates));
}

TEST(ViewFront, VisitsEverySettingOnceARound) {
    ViewFront front = three_points();
    std::vector<std::size_t> visited, counted, judged;
    while (const auto step = front.next()) {
        visited.push_back(step->point);
        if (step->counts) counted.push_back(step->point);
        if (step->judged) judged.push_back(step->point);
        front.took(1.0, 0.5);
    }
    EXPECT_EQ(visited, (std::vector<std::size_t>{0, 1, 2, 0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(counted, (std::vector<std::size_t>{0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(judged, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(front.done(), 1.0);
    front.took(1.0);
    EXPECT_EQ(front.done(), 1.0);
}

TEST(ViewFront, TellsTimesErrorsAndWhatIsOnTheFront) {
    ViewFront front = three_points();
    // The second is slower than the first and worse; the third slower and better.
    const std::vector<double> ms = {10.0, 20.0, 40.0};
    const std::vector<double> errors = {0.2, 0.3, 0.1};
    while (const auto step = front.next())
        front.took(step->judged ? 1.5 * ms[step->point] : ms[step->point], errors[step->point]);
    front.set_floor(0.04);
    const nlohmann::json json = front.json(false, 2);
    EXPECT_EQ(json.at("floor"), 0.04);
    EXPECT_EQ(json.at("running"), false);
    ASSERT_EQ(json.at("points").size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const nlohmann::json& point = json.at("points")[i];
        EXPECT_EQ(point.at("index"), i);
        EXPECT_EQ(point.at("ms"), 1.25 * ms[i]);
        EXPECT_EQ(point.at("low_ms"), ms[i]);
        EXPECT_EQ(point.at("high_ms"), 1.5 * ms[i]);
        EXPECT_EQ(point.at("error"), errors[i]);
        EXPECT_EQ(point.at("on_front"), i != 1);
        EXPECT_EQ(point.at("shown"), i == 2);
    }
}

TEST(ViewFront, HasNoPointsBeforeTheFirstTimeThatCounts) {
    ViewFront front = three_points();
    for (int i = 0; i < 3; ++i) front.took(5.0);
    EXPECT_TRUE(front.json(true, {}).at("points").empty());
    EXPECT_TRUE(front.json(true, {}).at("floor").is_null());
    front.took(7.0);
    EXPECT_EQ(front.json(true, {}).at("points").size(), 1U);
    EXPECT_TRUE(front.json(true, {}).at("points")[0].at("error").is_null());
    EXPECT_TRUE(ViewFront({}).json(false, {}).at("points").empty());
    EXPECT_FALSE(ViewFront({}).next());
}

}  // namespace
}  // namespace weft::view_front_test
