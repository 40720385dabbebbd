// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/session_stats.h"

#include <gtest/gtest.h>

namespace weft::session_stats_test {
namespace {

FrameStats frame_of(std::uint32_t image, std::uint32_t bad = 0, std::uint32_t pixel = 0) {
    FrameStats frame;
    frame.ms = 2.0;
    frame.rays = 10;
    frame.image = image;
    frame.nonfinite[COMPONENT_INDIRECT] = {bad, pixel};
    return frame;
}

TEST(SessionStats, NonfiniteValuesAreCountedBeyondTheFramesThatAreKept) {
    SessionStats stats(2);
    stats.add({frame_of(0), frame_of(1), frame_of(1), frame_of(1, 4, 77)});
    stats.add({frame_of(1, 3, 5)});
    for (std::uint32_t image = 2; image < 9; ++image) stats.add({frame_of(image)});
    EXPECT_EQ(stats.last_frames().size(), 2U);
    EXPECT_EQ(stats.frames(), 12U);
    EXPECT_EQ(stats.ms(), 24.0);
    EXPECT_EQ(stats.rays(), 120U);
    const std::vector<NonfiniteSummary> found = stats.nonfinite();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].component, "indirect");
    EXPECT_EQ(found[0].count, 7U);
    EXPECT_EQ(found[0].first_image, 1U);
    EXPECT_EQ(found[0].first_sample, 2U);
    EXPECT_EQ(found[0].first_pixel, 77U);
}

TEST(SessionStats, ImagesOfAnotherRendererFollow) {
    SessionStats stats(9);
    stats.begin_renderer();
    stats.add({frame_of(0), frame_of(1)});
    stats.begin_renderer();
    stats.add({frame_of(0), frame_of(1, 1, 3)});
    EXPECT_EQ(stats.last_frames()[2].image, 2U);
    EXPECT_EQ(stats.last_frames()[3].image, 3U);
    EXPECT_EQ(stats.nonfinite()[0].first_image, 3U);
    EXPECT_EQ(stats.nonfinite()[0].first_sample, 0U);
}

}  // namespace
}  // namespace weft::session_stats_test
