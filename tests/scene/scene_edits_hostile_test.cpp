// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "scene/scene_edits.h"
#include "scene/validate_scene.h"
#include "tests/testing/edited_room.h"

namespace weft::scene_edits_hostile_test {
namespace {

using test::Edited;
using test::placement;
using test::read_text;
using test::room;

/// What a call throws, from the `#` or the `:` after the file's name on, or "no error".
template <typename Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        if (error.code() != ExitCode::bad_input) return "wrong exit code";
        const std::string message = error.what();
        const std::string file = "edits.json";
        const std::size_t name = message.find(file);
        return name == std::string::npos ? message : message.substr(name + file.size());
    }
    return "no error";
}

std::string refusal_of_text(std::string_view text) {
    Scene scene = room();
    const std::string error = error_of([&] { (void)read_text(text, scene); });
    EXPECT_EQ(scene.instances.size(), room().instances.size()) << text;
    for (const Instance& instance : scene.instances) EXPECT_FALSE(instance.may_move) << text;
    return error;
}

std::string refusal(const std::string& edits) {
    return refusal_of_text("{\"edits\": [" + edits + "]}");
}

struct Case {
    const char* edits;
    const char* error;
};

/// Each edit is refused with its error, whose place begins with `#/edits/`.
void expect_refused(const std::vector<Case>& cases) {
    for (const Case& c : cases)
        EXPECT_EQ(refusal(c.edits), std::string("#/edits/") + c.error) << c.edits;
}

TEST(SceneEditsHostile, RefuseWrongFrames) {
    const std::string whole = ", expected a whole number that is not negative";
    EXPECT_EQ(refusal(R"({"frame": -1, "object": "Box", "move": [0,0,0]})"),
              "#/edits/0/frame: is -1" + whole);
    EXPECT_EQ(refusal(R"({"frame": 1.5, "object": "Box", "move": [0,0,0]})"),
              "#/edits/0/frame: is 1.5" + whole);
    expect_refused({
        {R"({"object": "Box"})", "0: lacks 'frame', which is required"},
        {R"(7)", "0: is of type number, expected an object"},
        {R"({"frame": "NaN"})", "0/frame: is of type string, expected a number"},
        {R"({"frame": 2147483648})", "0/frame: is 2147483648, expected a frame up to 2147483647"},
        {R"({"frame": 3, "until": 2, "object": "Box", "move": [0,0,0]})",
         "0/until: is 2, expected a frame after 3"},
        {R"({"frame": 3, "until": 3, "object": "Box", "move": [0,0,0]})",
         "0/until: is 3, expected a frame after 3"},
        {R"({"frame": 3, "until": 4, "object": "Box", "remove": true})",
         "0/until: has no meaning, 'remove' happens at once"},
        {R"({"frame": 3, "until": 4, "object": "Box", "add": {"name": "B"}})",
         "0/until: has no meaning, 'add' happens at once"},
    });
}

TEST(SceneEditsHostile, RefuseUnknownAndContradictoryKeys) {
    expect_refused({
        {R"({"frame": 0, "move": [0,0,0]})",
         "0: has none of 'object', 'light', 'material', expected one of them"},
        {R"({"frame": 0, "object": "Box", "light": "Bulb"})",
         "0: has both 'object' and 'light', expected one of them"},
        {R"({"frame": 0, "object": "Box", "move": [0,0,0], "remove": true})",
         "0: has both 'move' and 'remove', expected one of them"},
        {R"({"frame": 0, "object": "Box"})",
         "0: has none of 'move', 'rotate', 'scale', 'remove', 'add', expected one of them"},
        {R"({"frame": 0, "object": "Box", "move": [0,0,0], "by\n": 1})",
         "0: has the unknown key 'by?', expected 'frame', 'until', 'object', 'move', 'rotate', "
         "'scale', 'remove', 'add'"},
        {R"({"frame": 0, "object": "Box", "rotate": {"axis": [0,1,0], "angle": 1}})",
         "0/rotate: has the unknown key 'angle', expected 'axis', 'degrees', 'about'"},
        {R"({"frame": 0, "object": "Box", "add": {"name": "B", "matrix": 1}})",
         "0/add: has the unknown key 'matrix', expected 'name', 'translation', 'rotation', "
         "'scale', 'material'"},
        {R"({"frame": 0, "light": "Bulb", "remove": true})",
         "0: has the unknown key 'remove', expected 'frame', 'until', 'light', 'intensity', "
         "'move'"},
        {R"({"frame": 0, "light": "Bulb"})", "0: lacks a change, expected 'intensity' or 'move'"},
        {R"({"frame": 0, "material": "Red", "move": [0,0,0]})",
         "0: has the unknown key 'move', expected 'frame', 'until', 'material', 'albedo', "
         "'emission', 'emission_factor', 'roughness'"},
        {R"({"frame": 0, "material": "Red"})",
         "0: lacks a change, expected 'albedo', 'emission', 'emission_factor' or 'roughness'"},
    });
}

TEST(SceneEditsHostile, RefuseNames) {
    expect_refused({
        {R"({"frame": 0, "object": "Bax", "move": [0,0,0]})",
         "0/object: is 'Bax', but no object has that name"},
        {R"({"frame": 0, "object": "", "move": [0,0,0]})",
         "0/object: is '', but no object has that name"},
        {R"({"frame": 0, "object": 3, "move": [0,0,0]})",
         "0/object: is of type number, expected a string"},
        {R"({"frame": 0, "light": "Spot", "intensity": 1})",
         "0/light: is 'Spot', but 3 lights have that name, expected one"},
        {R"({"frame": 0, "light": "Sun", "move": [1,0,0]})",
         "0/move: moves a directional light, which is nowhere"},
        {R"({"frame": 0, "material": "Same", "emission_factor": 1})",
         "0/material: is 'Same', but 2 materials have that name, expected one"},
        {R"({"frame": 0, "object": "Box", "add": {}})", "0/add: lacks 'name', which is required"},
        {R"({"frame": 0, "object": "Box", "add": {"name": ""}})",
         "0/add/name: has 0 bytes, expected 1 to 256"},
        {R"({"frame": 0, "object": "Box", "add": {"name": "Wall"}})",
         "0/add/name: is 'Wall', which an object is called already"},
        {R"({"frame": 0, "object": "Box", "add": {"name": "B", "material": "Blue"}})",
         "0/add/material: is 'Blue', but no material has that name"},
    });
    const std::string removed = R"({"frame": 5, "object": "Box", "remove": true},)";
    EXPECT_EQ(refusal(removed + R"({"frame": 6, "object": "Box", "move": [0,0,0]})"),
              "#/edits/1/object: is 'Box', which is removed at frame 5");
    const std::string added = R"({"frame": 5, "object": "Box", "add": {"name": "B"}},)";
    EXPECT_EQ(refusal(added + R"({"frame": 4, "object": "B", "remove": true})"),
              "#/edits/1/object: is 'B', but no object has that name");
}

TEST(SceneEditsHostile, RefuseValues) {
    const auto box = [](const std::string& change) {
        return refusal(R"({"frame": 0, "object": "Box", )" + change + "}");
    };
    EXPECT_EQ(box(R"("move": [1, 2])"), "#/edits/0/move: has 2 elements, expected 3");
    EXPECT_EQ(box(R"("move": [1, 2, "inf"])"),
              "#/edits/0/move/2: is of type string, expected a number");
    EXPECT_EQ(box(R"("remove": false)"), "#/edits/0/remove: is false, expected true");
    const std::string factor = "has a factor that is 0 or negative, expected factors above 0";
    for (const char* scale : {"0", "-2", "[1, 0, 1]", "[1, 1, -1e-300]"})
        EXPECT_EQ(box(std::string(R"("scale": )") + scale), "#/edits/0/scale: " + factor);
    EXPECT_EQ(box(R"("rotate": {"axis": [0, 0, 0], "degrees": 1})"),
              "#/edits/0/rotate/axis: is of length 0, expected a direction");
    EXPECT_EQ(box(R"("rotate": {"axis": [0, 1, 0]})"),
              "#/edits/0/rotate: lacks 'degrees', which is required");
    const std::string add = R"("add": {"name": "B", )";
    EXPECT_EQ(box(add + R"("rotation": [0, 0, 0, 2]})"),
              "#/edits/0/add/rotation: is a quaternion of length 2.000000, expected 1");
    EXPECT_EQ(box(add + R"("scale": [1, 0, 1]})"),
              "#/edits/0/add: gives a transform that cannot be inverted");
    EXPECT_EQ(box(add + R"("scale": [1e200, 1e200, 1]})"),
              "#/edits/0/add: gives a transform that is not finite");
    EXPECT_EQ(box(add + R"("translation": [1e16, 0, 0]})"),
              "#/edits/0/add: is placed too far from the origin");
    expect_refused({
        {R"({"frame": 0, "light": "Bulb", "intensity": -1})",
         "0/intensity: is negative, expected a factor from 0 on"},
        {R"({"frame": 0, "material": "Red", "albedo": [0, 1.5, 0]})",
         "0/albedo/1: is outside [0, 1]"},
        {R"({"frame": 0, "material": "Red", "roughness": 1.5})", "0/roughness: is outside [0, 1]"},
        {R"({"frame": 0, "material": "Red", "roughness": 0.5})",
         "0/roughness: is for a material that has none"},
        {R"({"frame": 0, "material": "Red", "emission": [0, 0, 1e39]})",
         "0/emission/2: is negative or not finite as a float"},
    });
}

TEST(SceneEditsHostile, RefuseFilesThatAreNone) {
    EXPECT_EQ(refusal_of_text(""), ":1: JSON syntax error");
    EXPECT_EQ(refusal_of_text("{\n\"edits\": NaN}"), ":2: JSON syntax error");
    EXPECT_EQ(refusal_of_text("[]"), "#: is of type array, expected an object");
    EXPECT_EQ(refusal_of_text("{}"), "#: lacks 'edits', which is required");
    EXPECT_EQ(refusal_of_text(R"({"edits": {}})"), "#/edits: is of type object, expected an array");
    EXPECT_EQ(refusal_of_text(R"({"edits": [], "more": 1})"),
              "#: has the unknown key 'more', expected 'edits'");
    EXPECT_EQ(refusal_of_text(R"({"edits": [{"frame": 1e999}]})"),
              ":1: the number '1e999' is too large, expected at most 1.8e308");
    const std::string deep = ": JSON is nested deeper than 128 levels";
    EXPECT_EQ(refusal_of_text(std::string(1000000, '[')), deep);
    EXPECT_EQ(refusal_of_text(std::string(129, '[') + std::string(129, ']')), deep);
    EXPECT_EQ(refusal_of_text(std::string(128, '[') + std::string(128, ']')),
              "#: is of type array, expected an object");
    Scene scene = room();
    EXPECT_EQ(error_of([&] { (void)read_scene_edits("/nowhere/edits.json", scene); }).substr(0, 2),
              ": ");
    std::string many = "0";
    for (std::size_t i = 0; i < limits::max_scene_edits; ++i) many += ",0";
    EXPECT_EQ(refusal(many), "#/edits: has 100001 elements, expected at most 100000");
}

TEST(SceneEditsHostile, AFailedChangeNamesItsEditAndLeavesTheSceneBefore) {
    const auto failure = [](const std::string& changes) {
        const Edited edited(R"({"frame": 1, "object": "Box", "move": [1, 0, 0]}, )" + changes);
        const Scene before = edited.at(1);
        const std::string error = error_of([&] { (void)edited.at(2); });
        EXPECT_EQ(before.instances[0].to_world, placement(2.0, {2, 2, 3}));
        EXPECT_NO_THROW(validate_scene(before));
        EXPECT_EQ(edited.at(1).instances[0].to_world, before.instances[0].to_world);
        return error;
    };
    const std::string box = R"({"frame": 2, "object": "Box", )";
    const std::string far = "puts something too far from the origin";
    EXPECT_EQ(failure(box + R"("scale": 1e200})"),
              "#/edits/1/scale: makes a transform that is not finite");
    EXPECT_EQ(failure(box + R"("scale": 1e-200})"),
              "#/edits/1/scale: makes a transform that cannot be inverted");
    EXPECT_EQ(failure(box + R"("move": [0, 1e16, 0]})"), "#/edits/1/move: " + far);
    EXPECT_EQ(failure(box + R"("scale": 1e16})"), "#/edits/1/scale: " + far);
    const std::string move = box + R"("move": [1e308, 0, 0]})";
    EXPECT_EQ(failure(move + "," + move), "#/edits/2/move: makes a transform that is not finite");
    EXPECT_EQ(failure(box + R"("rotate": {"axis": [0,0,1], "degrees": 180,
                      "about": [1e308, 0, 0]}})"),
              "#/edits/1/rotate: makes a transform that is not finite");
    EXPECT_EQ(failure(R"({"frame": 2, "light": "Bulb", "move": [1e16, 0, 0]})"),
              "#/edits/1: " + far);
    EXPECT_EQ(failure(R"({"frame": 2, "light": "Bulb", "intensity": 1e38})"),
              "#/edits/1: makes a value that is not finite as a float");
    EXPECT_EQ(failure(R"({"frame": 2, "material": "Emissive", "emission_factor": 1e308})"),
              "#/edits/1: makes a value that is not finite as a float");
}

}  // namespace
}  // namespace weft::scene_edits_hostile_test
