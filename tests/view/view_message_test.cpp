// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_message.h"

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

namespace weft::view_message_test {
namespace {

std::string refusal(const std::string& text) {
    try {
        (void)read_view_message(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    return "no failure";
}

TEST(ViewMessage, ReadsEveryKind) {
    EXPECT_EQ(std::get<ViewKey>(read_view_message(R"({"token":"0a1b"})")).token, "0a1b");
    EXPECT_EQ(std::get<ViewAck>(read_view_message(R"({"ack":4294967295})")).sequence, 4294967295U);
    const auto camera = std::get<ViewCamera>(read_view_message(
        R"({"camera":{"from":[1,2.5,-3],"at":[0,0,0],"up":[0,1,0],"fov":40},"state":7,
            "moving":true})"));
    EXPECT_EQ(camera.view.from, glm::dvec3(1.0, 2.5, -3.0));
    EXPECT_EQ(camera.view.at, glm::dvec3(0.0));
    EXPECT_EQ(camera.view.up, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(camera.fov, 40.0);
    EXPECT_EQ(camera.state, 7U);
    EXPECT_TRUE(camera.moving);
    const auto settings = std::get<ViewSettings>(read_view_message(
        R"({"set":{"algorithm":"tic","quality":"high","size":[640,480],"exposure":-1.5,
            "tone":"agx","paused":true,"camera":"top"},"state":8})"));
    EXPECT_EQ(settings.algorithm, Algorithm::tic);
    EXPECT_EQ(settings.quality, Quality::high);
    EXPECT_EQ(settings.size.value().width, 640U);
    EXPECT_EQ(settings.size.value().height, 480U);
    EXPECT_EQ(settings.exposure_ev, -1.5);
    EXPECT_EQ(settings.tone, ToneCurve::agx);
    EXPECT_EQ(settings.paused, true);
    EXPECT_EQ(settings.camera, "top");
    EXPECT_EQ(settings.state, 8U);
    const auto some = std::get<ViewSettings>(read_view_message(R"({"set":{},"state":9})"));
    EXPECT_FALSE(some.algorithm || some.quality || some.size || some.exposure_ev || some.tone ||
                 some.paused || some.camera);
    const auto pick = std::get<ViewPick>(read_view_message(R"({"pick":[12,34]})"));
    EXPECT_EQ(pick.x, 12U);
    EXPECT_EQ(pick.y, 34U);
    EXPECT_EQ(std::get<ViewSave>(read_view_message(R"({"save":"exr"})")).file, SavedFile::exr);
    EXPECT_EQ(std::get<ViewSave>(read_view_message(R"({"save":"edits"})")).file, SavedFile::edits);
}

TEST(ViewMessage, ReadsWhatChangesAndJudgesAView) {
    const auto settings = std::get<ViewSettings>(read_view_message(
        R"({"set":{"frame":12,"samples":16,"overlay":"direct.level","trust":true,
            "compare":{"algorithm":"igi","quality":"draft","seconds":0.3}},
            "moving":true,"state":3})"));
    EXPECT_EQ(settings.frame, 12U);
    EXPECT_EQ(settings.samples, 16U);
    EXPECT_EQ(settings.overlay, "direct.level");
    EXPECT_EQ(settings.trust, true);
    EXPECT_TRUE(settings.moving);
    ASSERT_TRUE(settings.compare && *settings.compare);
    EXPECT_EQ(**settings.compare, (ViewComparison{Algorithm::igi, Quality::draft, 0.3}));
    const auto none =
        std::get<ViewSettings>(read_view_message(R"({"set":{"compare":null},"state":4})"));
    ASSERT_TRUE(none.compare);
    EXPECT_FALSE(*none.compare);
    const auto edit = std::get<ViewEdit>(read_view_message(
        R"({"edit":{"object":"lamp","move":[1,0,0.5]},"continues":true,"moving":true,"state":5})"));
    EXPECT_EQ(edit.change, R"({"move":[1,0,0.5],"object":"lamp"})");
    EXPECT_TRUE(edit.continues && edit.moving);
    EXPECT_EQ(edit.state, 5U);
    EXPECT_TRUE(std::get<ViewUndo>(read_view_message(R"({"undo":"all","state":6})")).all);
    EXPECT_FALSE(std::get<ViewUndo>(read_view_message(R"({"undo":"last","state":7})")).all);
    EXPECT_FALSE(std::get<ViewMeasure>(read_view_message(R"({"measure":false})")).begin);
    EXPECT_EQ(std::get<ViewAdopt>(read_view_message(R"({"adopt":2})")).point, 2U);
    EXPECT_EQ(state_of(read_view_message(R"({"undo":"last","state":7})")), 7U);
    EXPECT_EQ(state_of(read_view_message(R"({"adopt":2})")), 0U);
}

TEST(ViewMessage, RefusesWhatIsNoMessage) {
    EXPECT_EQ(refusal(""), "message#:1: JSON syntax error");
    EXPECT_EQ(refusal("[1]"), "message#: is not valid, expected a JSON object");
    EXPECT_EQ(refusal("{\"ack\":1} x"), "message#:1: JSON syntax error");
    EXPECT_EQ(refusal(R"({"ack":1,"ack":2})"),
              "message#: JSON has an object with the key 'ack' twice, expected it once");
    EXPECT_EQ(refusal(R"({"hello":1})"), "message#: is of no known kind");
    EXPECT_EQ(refusal(std::string(200, '[')), "message#: JSON is nested deeper than 128 levels");
    EXPECT_EQ(refusal(std::string(max_view_message_bytes + 1, ' ')),
              "message#: has 65537 bytes, expected at most 65536");
    for (const char* text :
         {R"({"token":1})",
          R"({"ack":-1})",
          R"({"ack":4294967296})",
          R"({"ack":1.5})",
          R"({"pick":[1]})",
          R"({"pick":[1,-1]})",
          R"({"save":"jpg"})",
          R"({"save":["png"]})",
          R"({"set":{"size":[0,4]},"state":1})",
          R"({"set":{"size":[32769,1]},"state":1})",
          R"({"set":{"size":[32768,32768]},"state":1})",
          R"({"set":{"algorithm":"magic"},"state":1})",
          R"({"set":{"quality":"best"},"state":1})",
          R"({"set":{"exposure":1e9},"state":1})",
          R"({"set":{"tone":3},"state":1})",
          R"({"set":{"paused":1},"state":1})",
          R"({"set":{"frame":16777216},"state":1})",
          R"({"set":{"samples":-1},"state":1})",
          R"({"set":{"overlay":3},"state":1})",
          R"({"set":{"compare":{"algorithm":"igi","quality":"draft"}},"state":1})",
          R"({"set":{"compare":{"algorithm":"igi","quality":"draft","seconds":0}},"state":1})",
          R"({"set":{"compare":4},"state":1})",
          R"({"edit":[1],"state":1})",
          R"({"edit":{"object":"lamp"}})",
          R"({"undo":"first","state":1})",
          R"({"measure":1})",
          R"({"adopt":-1})",
          R"({"set":{}})",
          R"({"set":{},"state":-1})",
          R"({"camera":{"from":[1,2,3],"at":[1,2,3],"up":[0,1,0],"fov":40},"state":1})",
          R"({"camera":{"from":[1,2],"at":[1,2,3],"up":[0,1,0],"fov":40},"state":1})",
          R"({"camera":{"from":[1e16,2,3],"at":[0,0,0],"up":[0,1,0],"fov":40},"state":1})",
          R"({"camera":{"from":[1,2,3],"at":[0,0,0],"up":[0,1,0],"fov":180},"state":1})",
          R"({"camera":{"from":[1,2,3],"at":[0,0,0],"up":[0,1,0]},"state":1})"})
        EXPECT_TRUE(refusal(text).starts_with("message#")) << text << ": " << refusal(text);
}

}  // namespace
}  // namespace weft::view_message_test
