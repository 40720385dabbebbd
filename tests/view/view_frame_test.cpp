// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_frame.h"

#include <gtest/gtest.h>

#include <array>

namespace weft::view_frame_test {
namespace {

TEST(ViewFrame, HeadsAreWhatPagesRead) {
    ViewFrame frame;
    frame.codec = ViewCodec::png;
    frame.moving = false;
    frame.final = true;
    frame.width = 513;
    frame.height = 2;
    frame.samples = 70000;
    frame.milliseconds = 0.5F;  // 3F 00 00 00
    const auto head = view_frame_head(frame, 3, 0x01020304);
    const std::array<int, view_frame_head_bytes> expected{'W',  'F',  'T', '1', 1, 0, 2, 0,   3, 0,
                                                          0,    0,    4,   3,   2, 1, 1, 2,   2, 0,
                                                          0x70, 0x11, 1,   0,   0, 0, 0, 0x3F};
    for (std::size_t i = 0; i < head.size(); ++i)
        EXPECT_EQ(static_cast<int>(head[i]), expected[i]) << i;
    frame.codec = ViewCodec::jpeg;
    frame.moving = true;
    frame.final = false;
    const auto other = view_frame_head(frame, 3, 4);
    EXPECT_EQ(static_cast<int>(other[4]), 0);
    EXPECT_EQ(static_cast<int>(other[6]), 1);
}

}  // namespace
}  // namespace weft::view_frame_test
