// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/frame_time_warning.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace weft::frame_time_warning_test {
namespace {

std::vector<FrameStats> frames(const std::vector<double>& times, bool can_save) {
    std::vector<FrameStats> result;
    for (const double ms : times) {
        FrameStats frame;
        frame.ms = ms;
        frame.levels.push_back({.component = "indirect", .gain = 16.0, .can_save = can_save});
        result.push_back(frame);
    }
    return result;
}

TEST(FrameTimeWarning, SaysWhatIsReachedWhereMoreCannotBe) {
    const auto warning = frame_time_warning(10.0, frames({90.0, 41.0, 43.0, 42.0}, false));
    ASSERT_TRUE(warning.has_value());
    EXPECT_EQ(warning->find("--frame-time: 10 ms cannot be reached"), 0U) << *warning;
    EXPECT_NE(warning->find("a sample takes 43 ms"), std::string::npos) << *warning;
    EXPECT_LE(warning->size(), 160U);
}

TEST(FrameTimeWarning, SaysThatMoreSamplesComeCloserWhereTheyDo) {
    const auto warning = frame_time_warning(40.0, frames({80.0}, true));
    ASSERT_TRUE(warning.has_value());
    EXPECT_NE(warning->find("40 ms were not reached, a sample took 80 ms"), std::string::npos)
        << *warning;
    EXPECT_LE(warning->size(), 160U);
}

TEST(FrameTimeWarning, IsSilentNearTheTargetAndForOneLateFrame) {
    EXPECT_FALSE(frame_time_warning(40.0, frames({45.0, 38.0, 42.0}, false)).has_value());
    EXPECT_FALSE(frame_time_warning(40.0, frames({39.0, 500.0, 41.0}, false)).has_value());
    EXPECT_FALSE(frame_time_warning(40.0, {}).has_value());
}

TEST(FrameTimeWarning, GoesByTheLastFramesOfALongRun) {
    std::vector<double> times(100, 90.0);
    times.insert(times.end(), 8, 40.0);
    EXPECT_FALSE(frame_time_warning(40.0, frames(times, true)).has_value());
}

}  // namespace
}  // namespace weft::frame_time_warning_test
