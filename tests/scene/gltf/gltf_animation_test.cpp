// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/limits.h"
#include "render/camera_params.h"
#include "scene/pose_scene.h"
#include "tests/testing/gltf_builder.h"

namespace weft::gltf_animation_test {
namespace {

using Json = nlohmann::json;

constexpr float quarter = 0.70710678F;  // sine and cosine of half a right angle

/// A triangle, and a camera "eye" in node 2, a child of node 1, with an animation that has no
/// channels yet.
class Film : public GltfBuilder {
  public:
    Film() : GltfBuilder(GltfBuilder::triangle()) {
        json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}}}}};
        json["nodes"].push_back({{"children", {2}}});
        json["nodes"].push_back({{"camera", 0}, {"name", "eye"}, {"translation", {0, 0, 5}}});
        json["scenes"][0]["nodes"] = {0, 1};
        json["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
    }

    [[nodiscard]] Json& animation(std::size_t index = 0) { return json["animations"][index]; }

    /// Adds a sampler with these accessors, and returns its index.
    std::size_t add_sampler(std::size_t input, std::size_t output, const char* interpolation = "") {
        Json sampler{{"input", input}, {"output", output}};
        if (*interpolation != '\0') sampler["interpolation"] = interpolation;
        animation()["samplers"].push_back(sampler);
        return animation()["samplers"].size() - 1;
    }

    void add_channel(std::size_t node, const char* path, std::size_t sampler) {
        animation()["channels"].push_back(
            {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
    }

    void animate(std::size_t node, const char* path, const std::vector<float>& times,
                 const std::vector<float>& values, const char* interpolation = "") {
        const bool turns = std::string(path) == "rotation";
        const std::size_t input = add_floats(times, "SCALAR", 1);
        const std::size_t output =
            turns ? add_floats(values, "VEC4", 4) : add_floats(values, "VEC3", 3);
        add_channel(node, path, add_sampler(input, output, interpolation));
    }
};

/// Camera `name` of the scene at `time`.
glm::dmat4 eye_at(const Scene& scene, double time) {
    return camera_at(scene, scene.cameras.at(0), time).to_world;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LE(glm::length(a - b), 1e-6)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(GltfAnimation, MovesACameraInEveryInterpolation) {
    Film film;
    film.animate(2, "translation", {0, 1}, {0, 0, 5, 2, 0, 5});
    Scene scene = film.read();
    EXPECT_TRUE(film.diagnostics.warnings().empty());
    EXPECT_EQ(scene.cameras.at(0).to_world[3], glm::dvec4(0, 0, 5, 1));
    EXPECT_EQ(eye_at(scene, 0.25)[3], glm::dvec4(0.5, 0, 5, 1));
    EXPECT_EQ(eye_at(scene, 7.0)[3], glm::dvec4(2, 0, 5, 1));
    film.animation()["samplers"][0]["interpolation"] = "LINEAR";
    EXPECT_EQ(eye_at(film.read(), 0.25)[3], glm::dvec4(0.5, 0, 5, 1));
    film.animation()["samplers"][0]["interpolation"] = "STEP";
    EXPECT_EQ(eye_at(film.read(), 0.25)[3], glm::dvec4(0, 0, 5, 1));
    Film spline;
    spline.animate(2, "translation", {0, 1}, {0, 0, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 2, 0, 5, 0, 0, 0},
                   "CUBICSPLINE");
    scene = spline.read();
    // 3 t^2 - 2 t^3 of the way where the tangents are 0.
    expect_near(glm::dvec3(eye_at(scene, 0.25)[3]), {2 * 0.15625, 0, 5});
}

TEST(GltfAnimation, PlaysParentsToo) {
    Film film;
    film.json["nodes"][1]["scale"] = {2, 2, 2};
    film.animate(1, "rotation", {0, 2}, {0, 0, 0, 1, 0, quarter, 0, quarter});
    const Scene scene = film.read();
    ASSERT_EQ(scene.animation.nodes.size(), 1U);
    expect_near(glm::dvec3(eye_at(scene, 0.0)[3]), {0, 0, 10});
    const double half = std::sqrt(0.5);
    expect_near(glm::dvec3(eye_at(scene, 1.0)[3]), {10 * half, 0, 10 * half});
    expect_near(glm::dvec3(eye_at(scene, 2.0)[3]), {10, 0, 0});
    expect_near(glm::normalize(glm::dvec3(eye_at(scene, 2.0)[2])), {1, 0, 0});
}

TEST(GltfAnimation, PlaysParentsAndChildrenAtOnceAlsoOfSeveralAnimations) {
    Film film;
    film.animate(2, "translation", {0, 1}, {0, 0, 5, 0, 0, 7});
    film.json["animations"].push_back(film.animation());
    film.animation() = {{"channels", Json::array()}, {"samplers", Json::array()}};
    film.animate(1, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    film.animate(1, "scale", {0, 1}, {1, 1, 1, 3, 3, 3});
    const Scene scene = film.read();
    EXPECT_TRUE(film.diagnostics.warnings().empty());
    expect_near(glm::dvec3(eye_at(scene, 1.0)[3]), {1, 0, 21});
    expect_near(glm::dvec3(eye_at(scene, 0.5)[3]), {0.5, 0, 12});
}

TEST(GltfAnimation, IsAtItsFirstKeyAtTimeZeroNotAtRest) {
    Film film;
    film.animate(2, "translation", {3, 4}, {1, 1, 1, 2, 2, 2});
    const Scene scene = film.read();
    EXPECT_EQ(scene.cameras.at(0).to_world[3], glm::dvec4(0, 0, 5, 1));
    EXPECT_EQ(eye_at(scene, 0.0)[3], glm::dvec4(1, 1, 1, 1));
}

TEST(GltfAnimation, StandsWhereAStaticNodeWouldStandToTheBit) {
    // A key's value as the node's own gives the same matrix, through parents that rest and move.
    const std::vector<float> turn{0.1F, 0.3F, -0.2F, 0.92F};
    Film film;
    film.json["nodes"][1]["translation"] = {0.1, 0.2, 0.3};
    film.json["nodes"][1]["rotation"] = {0.0, 0.6, 0.0, 0.8};
    Film resting = film;
    film.animate(2, "rotation", {0, 1}, {0, 0, 0, 1, turn[0], turn[1], turn[2], turn[3]});
    resting.json["nodes"][2]["rotation"] = turn;
    EXPECT_EQ(eye_at(film.read(), 1.0), resting.read().cameras.at(0).to_world);
}

TEST(GltfAnimation, ReadsRotationsOfNormalizedIntegers) {
    Film film;
    const std::size_t input = film.add_floats({0}, "SCALAR", 1);
    const std::size_t output =
        film.add_accessor<std::int16_t>({0, 23170, 0, 23170}, 5122, "VEC4", 1);
    film.json["accessors"][output]["normalized"] = true;
    film.add_channel(1, "rotation", film.add_sampler(input, output));
    expect_near(glm::dvec3(eye_at(film.read(), 0.0)[3]), {5, 0, 0});
    film.json["accessors"][output]["normalized"] = false;
    EXPECT_EQ(film.error(),
              "#/animations/0/samplers/0/output: chooses an accessor that holds no rotations, "
              "expected VEC4 of 5126 or of normalized integers");
}

TEST(GltfAnimation, SharesSamplersAndIgnoresUnusedOnes) {
    Film film;
    film.animate(1, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    film.add_channel(2, "translation", 0);
    film.animation()["samplers"].push_back({{"input", 99}, {"output", 99}});
    const Scene scene = film.read();
    EXPECT_EQ(scene.animation.tracks.size(), 1U);
    expect_near(glm::dvec3(eye_at(scene, 1.0)[3]), {2, 0, 0});
}

TEST(GltfAnimation, WarnsOfWhatIsNotPlayed) {
    Film film;
    film.animate(0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    film.animate(0, "translation", {0, 1}, {0, 0, 0, 9, 0, 0});
    film.animate(0, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    film.add_channel(0, "weights", 0);
    film.add_channel(0, "pointer", 0);
    film.add_channel(0, "weights", 0);
    film.animation()["channels"].push_back({{"sampler", 0}, {"target", {{"path", "scale"}}}});
    const Scene scene = film.read();
    EXPECT_EQ(film.diagnostics.warnings().size(), 4U);
    EXPECT_TRUE(film.warned_at("#/animations/0/channels/1/target",
                               "an earlier channel moves the same property, not played"));
    EXPECT_TRUE(film.warned_at("#/animations/0/channels/3/target",
                               "the node has no morph targets whose weights could be played"));
    EXPECT_TRUE(film.warned_at("#/animations/0/channels/4/target",
                               "a pointer is not animated, the value at rest is rendered instead"));
    EXPECT_TRUE(
        film.warned_at("#/animations/0/channels/6/target", "no node is named, nothing is played"));
    EXPECT_EQ(scene.instances.at(0).to_world, glm::dmat4(1.0));
    EXPECT_EQ(scene.animation.tracks.size(), 3U);
    const MovingNode& node = scene.animation.nodes.at(0);
    EXPECT_EQ(vector_at(scene.animation.tracks.at(static_cast<std::size_t>(node.translation)), 1.0),
              glm::dvec3(1, 0, 0));
}

TEST(GltfAnimation, ListsTheAnimationsOfTheFile) {
    Film film;
    film.json["animations"].push_back(film.json["animations"][0]);
    film.animation()["name"] = "walk";
    film.animate(1, "translation", {0.5F, 2}, {1, 0, 0, 5, 0, 0});
    film.animate(1, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    // The second moves the same property, which the first keeps.
    film.json["animations"][1]["samplers"] = film.animation()["samplers"];
    // Compilers disagree about braces around a single value.
    film.json["animations"][1]["channels"] = nlohmann::json::array();
    film.json["animations"][1]["channels"].push_back(film.animation()["channels"][0]);
    const Scene scene = film.read();
    ASSERT_EQ(scene.animation.clips.size(), 2U);
    const AnimationClip& walk = scene.animation.clips[0];
    EXPECT_EQ(walk.name, "walk");
    EXPECT_EQ(walk.duration, 2.0);
    EXPECT_EQ(walk.channels, 2U);
    EXPECT_EQ(walk.channels_played, 2U);
    const AnimationClip& second = scene.animation.clips[1];
    EXPECT_EQ(second.name, "animation 1");
    EXPECT_EQ(second.duration, 2.0);
    EXPECT_EQ(second.channels, 1U);
    EXPECT_EQ(second.channels_played, 0U);
}

TEST(GltfAnimation, MovesMeshesBelowAnAnimatedNode) {
    Film film;
    film.json["nodes"][1]["children"] = {2, 0};
    film.json["scenes"][0]["nodes"] = {1};
    film.animate(1, "translation", {0, 2}, {1, 0, 0, 5, 0, 0});
    const Scene scene = film.read();
    EXPECT_TRUE(scene.instances.at(0).may_move);
    EXPECT_TRUE(is_animated(scene));
    Scene posed = scene;
    for (const double time : {0.0, 1.0, 3.0}) {
        pose_scene(scene, time, posed);
        expect_near(glm::dvec3(posed.instances.at(0).to_world[3]),
                    {1.0 + 2.0 * std::min(time, 2.0), 0, 0});
    }
    hold_still(posed);
    EXPECT_FALSE(is_animated(posed));
}

/// The error after one value of a good animation is replaced.
std::string error_after(const char* pointer, const Json& value) {
    Film film;
    film.animate(2, "translation", {0, 1}, {0, 0, 5, 2, 0, 5});
    EXPECT_EQ(film.error(), "no error");
    film.json[Json::json_pointer(pointer)] = value;
    return film.error();
}

/// The error of an animation with these keys.
std::string error_of_keys(const char* path, const std::vector<float>& times,
                          const std::vector<float>& values, const char* interpolation = "") {
    Film film;
    film.animate(2, path, times, values, interpolation);
    return film.error();
}

TEST(GltfAnimation, RefusesBrokenStructure) {
    EXPECT_EQ(error_after("/animations", 3), "#/animations: is of type number, expected an array");
    EXPECT_EQ(error_after("/animations/0", Json::object()),
              "#/animations/0: lacks 'channels', which is required");
    EXPECT_EQ(error_after("/animations/0", {{"channels", Json::array()}}),
              "#/animations/0: lacks 'samplers', which is required");
    EXPECT_EQ(error_after("/animations/0/channels/0/sampler", 1),
              "#/animations/0/channels/0/sampler: is 1, but there are only 1 samplers");
    EXPECT_EQ(error_after("/animations/0/channels/0/target/node", 3),
              "#/animations/0/channels/0/target/node: is 3, but there are only 3 nodes");
    EXPECT_EQ(error_after("/animations/0/channels/0/target/node", -1),
              "#/animations/0/channels/0/target/node: is -1, expected a whole number that is not "
              "negative");
    EXPECT_EQ(error_after("/animations/0/channels/0/target/path", "colour"),
              "#/animations/0/channels/0/target/path: is 'colour', expected translation, rotation, "
              "scale or weights");
    EXPECT_EQ(error_after("/animations/0/samplers/0/interpolation", "LINEAR2"),
              "#/animations/0/samplers/0/interpolation: is 'LINEAR2', expected LINEAR, STEP or "
              "CUBICSPLINE");
    EXPECT_EQ(error_after("/animations/0/samplers/0/input", 9),
              "#/animations/0/samplers/0/input: is 9, but there are only 3 accessors");
    EXPECT_EQ(
        error_after("/nodes/2", {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}),
        "#/animations/0/channels/0/target/node: node 2 has a 'matrix', expected translation, "
        "rotation and scale of a node that is animated");
}

TEST(GltfAnimation, RefusesAccessorsOfTheWrongKind) {
    // Accessor 0 holds corners, 1 times, 2 places.
    EXPECT_EQ(error_after("/animations/0/samplers/0/input", 2),
              "#/animations/0/samplers/0/input: chooses an accessor that holds no times, expected "
              "SCALAR of 5126");
    EXPECT_EQ(error_after("/accessors/1/componentType", 5125),
              "#/animations/0/samplers/0/input: chooses an accessor that holds no times, expected "
              "SCALAR of 5126");
    EXPECT_EQ(error_after("/animations/0/samplers/0/output", 1),
              "#/animations/0/samplers/0/output: chooses an accessor that holds no vectors, "
              "expected VEC3 of 5126");
    EXPECT_EQ(error_after("/animations/0/samplers/0/output", 0),
              "#/animations/0/samplers/0/output: chooses 3 values, expected 1 for each of 2 keys");
    EXPECT_EQ(error_after("/animations/0/samplers/0/interpolation", "CUBICSPLINE"),
              "#/animations/0/samplers/0/output: chooses 2 values, expected 3 for each of 2 keys");
    EXPECT_EQ(error_after("/animations/0/channels/0/target/path", "rotation"),
              "#/animations/0/samplers/0/output: chooses an accessor that holds no rotations, "
              "expected VEC4 of 5126 or of normalized integers");
    Film film;
    film.animate(1, "rotation", {0}, {0, 0, 0, 1});
    film.add_channel(2, "translation", 0);
    EXPECT_EQ(
        film.error(),
        "#/animations/0/channels/1/sampler: sampler 0 has values for another kind of property "
        "as well");
}

TEST(GltfAnimation, RefusesImpossibleKeys) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::string time = "#/animations/0/samplers/0/input: time of key ";
    const std::vector<float> two{0, 0, 0, 1, 1, 1};
    EXPECT_EQ(error_of_keys("scale", {-1, 1}, two),
              time + "0 is negative or not finite, expected seconds from 0 on");
    EXPECT_EQ(error_of_keys("scale", {0, infinity}, two),
              time + "1 is negative or not finite, expected seconds from 0 on");
    EXPECT_EQ(error_of_keys("scale", {0, std::nanf("")}, two),
              time + "1 is negative or not finite, expected seconds from 0 on");
    for (const float second : {1.0F, 0.5F})
        EXPECT_EQ(error_of_keys("scale", {1, second}, two),
                  time + "1 does not increase, expected strictly increasing times");
    EXPECT_EQ(error_of_keys("translation", {0, 1}, {0, 0, 0, 0, infinity, 0}),
              "#/animations/0/samplers/0/output: value 1 is not finite");
    EXPECT_EQ(error_of_keys("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 0.5}),
              "#/animations/0/samplers/0/output: key 1 is a quaternion of length 0.500000, "
              "expected 1");
    // Tangents of a spline have any length.
    EXPECT_EQ(error_of_keys("rotation", {0}, {0, 0, 0, 0, 0, 0, 0, 1, 0, 9, 0, 0}, "CUBICSPLINE"),
              "no error");
}

TEST(GltfAnimation, RefusesEndlessKeysBeforeReadingThem) {
    // Each sampler would copy the keys of one accessor, which has no bytes in the file.
    Film film;
    film.json["accessors"].push_back(
        {{"componentType", 5126}, {"type", "SCALAR"}, {"count", limits::max_animation_keys}});
    const std::size_t many = film.json["accessors"].size() - 1;
    film.animate(1, "translation", {0}, {1, 1, 1});
    film.add_channel(1, "scale", film.add_sampler(many, many));
    EXPECT_EQ(film.error(), "#/animations/0/samplers/1/input: brings the file above the limit of " +
                                std::to_string(limits::max_animation_keys) + " animation keys");
}

TEST(GltfAnimation, ACameraThatVanishesIsAnErrorOfItsTime) {
    Film film;
    film.animate(1, "scale", {0, 1}, {1, 1, 1, 0, 0, 0});
    const Scene scene = film.read();
    EXPECT_NO_THROW((void)eye_at(scene, 0.5));
    try {
        (void)eye_at(scene, 1.0);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_NE(std::string(error.what())
                      .find("camera 'eye' at 1 s has a transform that cannot be inverted"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace weft::gltf_animation_test
