// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/camera_options.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/testing/parse_options.h"

namespace weft::camera_options_test {
namespace {

using test::render;
using test::render_refusal;

TEST(CameraOptions, PlaceTheCamera) {
    const CameraPlacement none = render({"--camera", "top"}).placement;
    EXPECT_FALSE(none.view || none.fov);
    const CameraPlacement placed =
        render({"--look-from", "-1,2.5,3e-2", "--look-at", "0,0,-4", "--fov", "35"}).placement;
    ASSERT_TRUE(placed.view && placed.fov);
    EXPECT_EQ(placed.view->from, glm::dvec3(-1.0, 2.5, 0.03));
    EXPECT_EQ(placed.view->at, glm::dvec3(0.0, 0.0, -4.0));
    EXPECT_EQ(placed.view->up, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(*placed.fov, 35.0);
    const CameraPlacement above =
        render({"--look-from", "0,5,0", "--look-at", "0,0,0", "--up", "0,0,-1"}).placement;
    EXPECT_EQ(above.view.value().up, glm::dvec3(0.0, 0.0, -1.0));
}

TEST(CameraOptions, PlacementsComeBackToTheLastBit) {
    const CameraPlacement placement{
        CameraView{{1.0 / 3.0, -2e-17, 12345.678901234567}, {0.1, 0.2, 0.3}, {1e-3, 1.0, 0.7}},
        54.321000000000005};
    const std::vector<std::string> arguments = placement_arguments(placement);
    std::vector<const char*> argv{"weft", "render", "box.gltf"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    const auto read =
        std::get<RenderOptions>(parse_command_line(static_cast<int>(argv.size()), argv.data()));
    ASSERT_TRUE(read.placement.view);
    EXPECT_EQ(read.placement.view->from, placement.view->from);
    EXPECT_EQ(read.placement.view->at, placement.view->at);
    EXPECT_EQ(read.placement.view->up, placement.view->up);
    EXPECT_EQ(read.placement.fov, placement.fov);
    EXPECT_TRUE(placement_arguments({}).empty());
}

TEST(CameraOptions, RefuseHalfAViewAndWhatNoCameraCanDo) {
    EXPECT_EQ(render_refusal({"--look-from", "1,2,3"}),
              "--look-from: says only half of a view, expected --look-at with it");
    EXPECT_EQ(render_refusal({"--look-at", "1,2,3"}),
              "--look-at: says only half of a view, expected --look-from with it");
    EXPECT_EQ(render_refusal({"--up", "0,0,1"}),
              "--up: is for a camera that is placed, expected --look-from and --look-at with it");
    EXPECT_EQ(render_refusal({"--look-from", "1,2,3", "--look-at", "1,2,3"}),
              "--look-at: is where the camera stands, expected another point than --look-from");
    EXPECT_EQ(render_refusal({"--look-from", "0,2,0", "--look-at", "0,0,0"}),
              "--up: is along the view from --look-from to --look-at, or 0, expected another "
              "direction");
    for (const char* text :
         {"1,2", "1,2,3,4", "1,,3", "a,b,c", "1,2,1e16", "1,2,nan", "1 2 3", "1,2,3,"})
        EXPECT_EQ(render_refusal({"--look-from", text, "--look-at", "0,0,0"}),
                  std::string("--look-from: '") + text +
                      "' is not valid, expected three numbers, such as 1,2.5,-3, up to 1e+15");
    for (const char* text : {"0", "180", "-40", "wide"})
        EXPECT_TRUE(render_refusal({"--fov", text}).starts_with("--fov: '")) << text;
}

TEST(CameraOptions, StatisticsNameThePlacement) {
    const nlohmann::json none = options_json(render({}));
    for (const char* key : {"look_from", "look_at", "up", "fov"})
        EXPECT_TRUE(none.at(key).is_null()) << key;
    const nlohmann::json placed =
        options_json(render({"--look-from", "1,2,3", "--look-at", "0,0,-4.5", "--fov", "35"}));
    EXPECT_EQ(placed.at("look_from"), nlohmann::json({1.0, 2.0, 3.0}));
    EXPECT_EQ(placed.at("look_at"), nlohmann::json({0.0, 0.0, -4.5}));
    EXPECT_EQ(placed.at("up"), nlohmann::json({0.0, 1.0, 0.0}));
    EXPECT_EQ(placed.at("fov"), 35.0);
}

}  // namespace
}  // namespace weft::camera_options_test
