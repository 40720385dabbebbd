// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_edits.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/limits.h"

namespace weft::view_edits_test {
namespace {

TEST(ViewEdits, IsEmptyWithoutChanges) {
    ViewEdits edits;
    EXPECT_EQ(edits.text(), "");
    edits.undo();
    EXPECT_EQ(edits.count(), 0U);
}

TEST(ViewEdits, WritesChangesWithTheirFrames) {
    ViewEdits edits;
    edits.add(R"({"object":"a","move":[0.1,0,0]})", 3, false);
    edits.add(R"({"material":"b","roughness":0.25})", 0, false);
    EXPECT_EQ(edits.text(), R"({"edits":[{"frame":3,"move":[0.1,0,0],"object":"a"},)"
                            R"({"frame":0,"material":"b","roughness":0.25}]})");
}

TEST(ViewEdits, AChangeThatContinuesTakesThePlaceOfTheOneBefore) {
    ViewEdits edits;
    edits.add(R"({"object":"a","move":[1,0,0]})", 0, false);
    edits.add(R"({"object":"a","move":[2,0,0]})", 0, true);
    EXPECT_EQ(edits.text(), R"({"edits":[{"frame":0,"move":[2,0,0],"object":"a"}]})");
    // Of other things, or in another frame, it is a change of its own.
    edits.add(R"({"object":"b","move":[2,0,0]})", 0, true);
    edits.add(R"({"object":"b","move":[2,0,0]})", 1, true);
    edits.add(R"({"light":"b","move":[2,0,0]})", 1, true);
    EXPECT_EQ(edits.count(), 4U);
    edits.undo();
    EXPECT_EQ(edits.count(), 3U);
    edits.clear();
    EXPECT_EQ(edits.text(), "");
}

TEST(ViewEdits, RefusesTimesOfPagesAndTooManyChanges) {
    ViewEdits edits;
    EXPECT_THROW(edits.add(R"({"frame":1,"object":"a","remove":true})", 0, false), Error);
    EXPECT_THROW(edits.add(R"({"until":1,"object":"a","move":[1,0,0]})", 0, false), Error);
    EXPECT_EQ(edits.count(), 0U);
    const std::string change = R"({"object":"a","move":[1,0,0]})";
    for (std::size_t i = 0; i < limits::max_scene_edits; ++i) edits.add(change, 0, false);
    EXPECT_THROW(edits.add(change, 0, false), Error);
    EXPECT_NO_THROW(edits.add(change, 0, true));
    EXPECT_EQ(edits.count(), limits::max_scene_edits);
}

}  // namespace
}  // namespace weft::view_edits_test
