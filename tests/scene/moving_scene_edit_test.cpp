// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "base/error.h"
#include "scene/moving_scene.h"
#include "scene/pose_scene.h"
#include "tests/testing/moving_room.h"

// Scenes that move and are edited from outside while they do: nothing of an edit is lost, nothing
// of a refused one stays, and timelines never point at what is gone.
namespace weft::moving_scene_edit_test {
namespace {

/// A room whose block slides, lit from everywhere too.
Scene open_room() {
    Scene scene = test::sliding_room();
    scene.environment = Environment{glm::vec3(0.1F)};
    return scene;
}

/// The code of the error that it ends with, or success.
ExitCode code_of(const std::function<void()>& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::success;
}

void set_environment(MovingScene& moving, float radiance) {
    EXPECT_TRUE(moving.edit(
        [&](const SceneParts& parts) { parts.environment->radiance = glm::vec3(radiance); }));
}

TEST(MovingSceneEdit, TheEnvironmentOfAFrameIsThatOfTheSceneAtRest) {
    for (const bool posed_before : {false, true}) {
        MovingScene moving(open_room(), {}, 1.0);
        if (posed_before) moving.set_frame(2);
        set_environment(moving, 0.4F);
        EXPECT_EQ(moving.flat().environment.r, 0.4F) << posed_before;
        moving.set_frame(3);
        EXPECT_EQ(moving.flat().environment.r, 0.4F) << posed_before;
    }
}

TEST(MovingSceneEdit, AnUnusableEnvironmentIsRefused) {
    for (const bool posed_before : {false, true})
        for (const float radiance : {-1.0F, std::numeric_limits<float>::quiet_NaN()}) {
            MovingScene moving(open_room(), {}, 1.0);
            if (posed_before) moving.set_frame(2);
            EXPECT_EQ(code_of([&] { set_environment(moving, radiance); }), ExitCode::bad_input);
            EXPECT_EQ(moving.at_rest().environment->radiance.r, 0.1F);
            moving.set_frame(3);
            EXPECT_EQ(moving.flat().environment.r, 0.1F);
        }
}

TEST(MovingSceneEdit, AFrameAfterARefusedRebuildIsTheOneBefore) {
    MovingScene moving(open_room(), {}, 1.0);
    moving.set_frame(2);
    const FlatScene before = moving.flat();
    // More vertices than there is room for, and a block that the frame puts out of reach.
    const auto rebuild = [&] {
        moving.rebuild([](Scene& scene) {
            for (Mesh& mesh : scene.meshes) {
                mesh.positions.resize(mesh.positions.size() + 100, mesh.positions.front());
                mesh.normals.clear();
                mesh.uvs.clear();
                mesh.colours.clear();
            }
            scene.animation.tracks[0].values = {0.0F, 0.0F, 0.0F, 1e20F, 0.0F, 0.0F};
        });
    };
    EXPECT_EQ(code_of(rebuild), ExitCode::bad_input);
    moving.set_frame(1);
    moving.set_frame(2);
    ASSERT_EQ(moving.flat().positions.size(), before.positions.size());
    for (std::size_t i = 0; i < before.positions.size(); ++i)
        EXPECT_EQ(moving.flat().positions[i].x, before.positions[i].x) << i;
}

TEST(MovingSceneEdit, TimelinesDoNotPointAtWhatIsGone) {
    Scene scene = open_room();
    PunctualLight light;
    light.position = {0.1, 0.4, 0.5};
    scene.lights.push_back(light);
    const auto last = [](std::size_t count) { return static_cast<std::uint32_t>(count - 1); };
    const std::string place = "edits.json#/edits/0";
    const std::pair<SceneEdit, std::function<void(Scene&)>> cases[] = {
        {SceneEdit{place, 1, 1, {last(scene.instances.size())}, ObjectPresence{}},
         [](Scene& all) { all.instances.pop_back(); }},
        {SceneEdit{place, 1, 1, {last(scene.lights.size())}, LightChange{}},
         [](Scene& all) { all.lights.pop_back(); }},
        {SceneEdit{place, 1, 1, {last(scene.materials.size())}, MaterialChange{}}, [](Scene& all) {
             all.materials.pop_back();
             for (Instance& instance : all.instances) instance.material = 0;
         }}};
    for (const auto& [change, remove] : cases) {
        MovingScene moving(scene, EditTimeline{{change}}, 1.0);
        moving.set_frame(2);
        try {
            moving.rebuild(remove);
            ADD_FAILURE() << change.change.index();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
        }
        moving.set_frame(3);
    }
}

TEST(MovingSceneEdit, WhatIsAttachedToANodeMovesFromThenOn) {
    Scene scene = test::moving_room(1).scene;
    scene.animation.nodes.push_back(test::sliding_node(scene));
    MovingScene moving(scene, {}, 1.0);
    EXPECT_FALSE(moving.moves());
    EXPECT_FALSE(moving.edit([](const SceneParts& parts) {
        parts.lights[0].motion = {0, glm::dmat4(1.0)};
    }));
    EXPECT_TRUE(moving.moves());
    // A node that is not there.
    EXPECT_EQ(code_of([&] {
                  moving.edit([](const SceneParts& parts) {
                      parts.lights[0].motion = {7, glm::dmat4(1.0)};
                  });
              }),
              ExitCode::bad_input);
}

/// The room with names for its parts, and an edit that begins with a dark light.
Scene named_room() {
    Scene scene = open_room();
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        scene.instances[i].name = "thing " + std::to_string(i);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        scene.materials[i].name = "material " + std::to_string(i);
    return scene;
}

std::function<EditTimeline(Scene&)> reading(const std::string& edits) {
    return [edits](Scene& scene) {
        return edits.empty() ? EditTimeline{}
                             : read_scene_edits(nlohmann::json::parse(edits), "edits", scene);
    };
}

/// That a scene is what one is that was made with these edits.
void expect_made_with(const MovingScene& moving, const Scene& scene, const std::string& edits,
                      std::uint32_t frame) {
    Scene rest = scene;
    EditTimeline timeline = reading(edits)(rest);
    MovingScene made(std::move(rest), std::move(timeline), 1.0);
    made.set_frame(frame);
    const FlatScene& a = moving.flat();
    const FlatScene& b = made.flat();
    const auto same_bytes = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
    };
    EXPECT_TRUE(same_bytes(a.positions, b.positions)) << edits;
    EXPECT_TRUE(same_bytes(a.triangles, b.triangles)) << edits;
    EXPECT_TRUE(same_bytes(a.materials, b.materials)) << edits;
    EXPECT_TRUE(same_bytes(a.lights, b.lights)) << edits;
    EXPECT_EQ(a.first_powers, b.first_powers) << edits;
    EXPECT_EQ(a.first_moving_triangle, b.first_moving_triangle) << edits;
    EXPECT_EQ(a.features, b.features) << edits;
}

TEST(MovingSceneEdit, EditsThatAreReplacedLeaveNothingBehind) {
    const std::string move = R"({"edits":[{"frame":0,"object":"thing 1","move":[0.1,0,0]},)"
                             R"({"frame":0,"material":"material 1","emission":[1,2,3]}]})";
    const std::string farther = R"({"edits":[{"frame":0,"object":"thing 1","move":[0.2,0,0]}]})";
    const std::string copy = R"({"edits":[{"frame":1,"object":"thing 1","add":{"name":"copy"}},)"
                             R"({"frame":2,"object":"copy","remove":true}]})";
    const std::string shine =
        R"({"edits":[{"frame":0,"material":"material 1","emission":[4,4,4]}]})";
    for (const bool animated : {false, true}) {
        Scene scene = named_room();
        if (!animated) hold_still(scene);
        MovingScene moving(scene, {}, 1.0);
        EXPECT_FALSE(moving.set_edits(reading(move), 0));
        expect_made_with(moving, scene, move, 0);
        // The same instances may move.
        EXPECT_TRUE(moving.set_edits(reading(farther), 0));
        expect_made_with(moving, scene, farther, 0);
        for (const std::uint32_t frame : {1U, 2U}) {
            (void)moving.set_edits(reading(copy), frame);
            expect_made_with(moving, scene, copy, frame);
        }
        // Its power is that of these edits, not of the ones before.
        (void)moving.set_edits(reading(move), 0);
        (void)moving.set_edits(reading(shine), 0);
        expect_made_with(moving, scene, shine, 0);
        (void)moving.set_edits(reading(""), 3);
        expect_made_with(moving, scene, "", 3);
        EXPECT_EQ(moving.now().instances.size(), scene.instances.size());
    }
}

TEST(MovingSceneEdit, RefusedEditsLeaveTheOnesBefore) {
    const Scene scene = named_room();
    const std::string good = R"({"edits":[{"frame":0,"object":"thing 1","move":[0.1,0,0]}]})";
    MovingScene moving(scene, {}, 1.0);
    (void)moving.set_edits(reading(good), 0);
    for (const char* bad : {R"({"edits":[{"frame":0,"object":"nothing","move":[0.1,0,0]}]})",
                            R"({"edits":[{"frame":0,"object":"thing 1","move":[1e300,0,0]}]})",
                            R"({"edits":[{"frame":0,"object":"thing 2","move":[1e300,0,0]}]})",
                            R"({"edits":[{"frame":0,"object":"thing 1","scale":1e-320}]})"}) {
        EXPECT_EQ(code_of([&] { (void)moving.set_edits(reading(bad), 0); }), ExitCode::bad_input)
            << bad;
        expect_made_with(moving, scene, good, 0);
        moving.set_frame(2);
        expect_made_with(moving, scene, good, 2);
        moving.set_frame(0);
    }
}

}  // namespace
}  // namespace weft::moving_scene_edit_test
