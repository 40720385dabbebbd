// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_morph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/limits.h"
#include "scene/pose_scene.h"
#include "tests/testing/gltf_limb.h"

namespace weft::gltf_morph_test {
namespace {

using Json = nlohmann::json;
using test::Limb;

constexpr std::size_t across = 1;  ///< accessor of the deltas of one target
constexpr std::size_t upwards = 2;

/// A triangle with two targets: one moves its corners by 1, 2 and 3 along z, the other all of them
/// by 1 along y.
GltfBuilder face() {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.add_floats({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3", 3);
    builder.add_floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3", 3);
    builder.primitive()["targets"] = {{{"POSITION", across}}, {{"POSITION", upwards}}};
    return builder;
}

/// Animates the weights of node 0.
void animate(GltfBuilder& builder, const std::vector<float>& times,
             const std::vector<float>& values, const char* interpolation) {
    const std::size_t input = builder.add_floats(times, "SCALAR", 1);
    const std::size_t output = builder.add_floats(values, "SCALAR", 1);
    builder.json["animations"] = {
        {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
}

glm::vec3 corner(const Scene& scene, std::size_t index, std::size_t instance = 0) {
    return scene.meshes.at(scene.instances.at(instance).mesh).positions.at(index);
}

Scene posed_at(const Scene& scene, double time) {
    Scene posed = scene;
    pose_scene(scene, time, posed);
    return posed;
}

TEST(GltfMorph, TargetsWithoutWeightsAreNotRead) {
    GltfBuilder builder = face();
    builder.primitive()["targets"][1]["POSITION"] = 99;
    builder.json["meshes"][0]["weights"] = {0, 0};
    builder.json["nodes"].push_back({{"mesh", 0}});
    builder.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = builder.read();
    EXPECT_TRUE(builder.diagnostics.warnings().empty());
    EXPECT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(corner(scene, 2), glm::vec3(0, 1, 0));
    EXPECT_FALSE(is_animated(scene));
}

TEST(GltfMorph, TakesTheWeightsOfTheNodeElseOfTheMesh) {
    GltfBuilder builder = face();
    builder.json["meshes"][0]["weights"] = {0.5, 0};
    builder.json["nodes"].push_back({{"mesh", 0}, {"weights", {1, -2}}});
    builder.json["nodes"].push_back({{"mesh", 0}});
    builder.json["nodes"].push_back({{"mesh", 0}, {"weights", {0, 0}}});
    builder.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = builder.read();
    EXPECT_EQ(corner(scene, 2, 0), glm::vec3(0, 1, 1.5));
    EXPECT_EQ(corner(scene, 2, 1), glm::vec3(0, -1, 3));
    EXPECT_EQ(corner(scene, 2, 3), glm::vec3(0, 1, 0));
    // What is the same is there once.
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh);
    EXPECT_EQ(scene.meshes.size(), 3U);
    for (const Instance& instance : scene.instances) EXPECT_FALSE(instance.may_move);
    EXPECT_TRUE(scene.deformations.empty());
}

TEST(GltfMorph, ReadsSparseAndQuantizedTargets) {
    GltfBuilder builder = face();
    const std::size_t indices = builder.add_view<std::uint16_t>({1, 2});
    const std::size_t values = builder.add_view<std::int8_t>({0, 0, 127, 0, 0, -127});
    builder.json["accessors"][across] = {
        {"componentType", 5120},
        {"normalized", true},
        {"type", "VEC3"},
        {"count", 3},
        {"sparse",
         {{"count", 2},
          {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
          {"values", {{"bufferView", values}}}}}};
    builder.json["nodes"][0]["weights"] = {2, 0};
    const Scene scene = builder.read();
    EXPECT_EQ(corner(scene, 0), glm::vec3(0, 0, 0));
    EXPECT_EQ(corner(scene, 1), glm::vec3(1, 0, 2));
    EXPECT_EQ(corner(scene, 2), glm::vec3(0, 1, -2));
}

TEST(GltfMorph, MovesNormalsWhereTheMeshHasSome) {
    GltfBuilder builder = face();
    const std::size_t deltas = builder.add_floats({1, 0, -1, 1, 0, 0, 0, 0, -1}, "VEC3", 3);
    builder.primitive()["targets"][0]["NORMAL"] = deltas;
    builder.json["nodes"][0]["weights"] = {1, 0};
    EXPECT_TRUE(builder.read().meshes[0].normals.empty());
    builder.primitive()["attributes"]["NORMAL"] =
        builder.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    const Mesh mesh = builder.read().meshes[0];
    ASSERT_EQ(mesh.normals.size(), 3U);
    EXPECT_EQ(mesh.normals[0], glm::vec3(1, 0, 0));
    EXPECT_LT(glm::length(mesh.normals[1] - glm::vec3(0.70710678F, 0, 0.70710678F)), 1e-6F);
    // Without a direction it is the triangle's.
    EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, 0));
}

TEST(GltfMorph, AnimatesWeightsInEveryInterpolation) {
    const std::vector<float> keys{0, 1, 1, -1};
    GltfBuilder linear = face();
    animate(linear, {0, 2}, keys, "LINEAR");
    Scene scene = linear.read();
    EXPECT_TRUE(linear.diagnostics.warnings().empty());
    EXPECT_TRUE(scene.instances[0].may_move);
    EXPECT_TRUE(is_animated(scene));
    // Without --frames, weights are those at rest.
    EXPECT_EQ(corner(scene, 2), glm::vec3(0, 1, 0));
    EXPECT_EQ(corner(posed_at(scene, 0.0), 2), glm::vec3(0, 2, 0));
    EXPECT_EQ(corner(posed_at(scene, 0.5), 2), glm::vec3(0, 1.5, 0.75));
    EXPECT_EQ(corner(posed_at(scene, 9.0), 2), glm::vec3(0, 0, 3));
    GltfBuilder step = face();
    animate(step, {0, 2}, keys, "STEP");
    EXPECT_EQ(corner(posed_at(step.read(), 1.9), 2), glm::vec3(0, 2, 0));
    EXPECT_EQ(corner(posed_at(step.read(), 2.0), 2), glm::vec3(0, 0, 3));
    GltfBuilder cubic = face();
    // Tangents before and after the values of each key; the first leaves with a slope of 4 and 0.
    animate(cubic, {0, 2}, {9, 9, 0, 1, 4, 0, 0, 0, 1, -1, 9, 9}, "CUBICSPLINE");
    // At a quarter of 2 s: 3 t^2 - 2 t^3 = 0.15625, t^3 - 2 t^2 + t = 0.140625.
    const glm::vec3 at_quarter = corner(posed_at(cubic.read(), 0.5), 2);
    EXPECT_NEAR(at_quarter.z, 3.0 * (0.15625 + 8.0 * 0.140625), 1e-6);
    EXPECT_NEAR(at_quarter.y, 1.0 + 1.0 - 2.0 * 0.15625, 1e-6);
}

TEST(GltfMorph, ReadsWeightsOfNormalizedIntegers) {
    GltfBuilder builder = face();
    animate(builder, {0}, {0, 0}, "LINEAR");
    const std::size_t output = builder.add_accessor<std::uint8_t>({255, 0}, 5121, "SCALAR", 2);
    builder.json["accessors"][output]["normalized"] = true;
    builder.json["animations"][0]["samplers"][0]["output"] = output;
    EXPECT_EQ(corner(posed_at(builder.read(), 0.0), 1), glm::vec3(1, 0, 2));
}

TEST(GltfMorph, AWeightedMeshMovesWithItsNodeAsWell) {
    GltfBuilder builder = face();
    animate(builder, {0, 1}, {0, 0, 1, 0}, "LINEAR");
    builder.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1};
    const Scene scene = builder.read();
    EXPECT_EQ(glm::dvec3(scene.instances[0].to_world[3]), glm::dvec3(4, 5, 6));
    EXPECT_FALSE(scene.instances[0].motion.moves());
    EXPECT_EQ(corner(posed_at(scene, 1.0), 0), glm::vec3(0, 0, 1));
}

TEST(GltfMorph, JointsCarryWhatTargetsMake) {
    Limb limb;
    const std::size_t deltas =
        limb.add_floats({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}, "VEC3", 3);
    limb.primitive()["targets"] = {{{"POSITION", deltas}}};
    limb.json["nodes"][Limb::tip]["rotation"] = {0, 0, 0.70710678, 0.70710678};
    limb.animate(Limb::limb, "weights", {0, 1}, {0, 1});
    const Scene scene = limb.read();
    // The skeleton rests, but is needed over time.
    ASSERT_EQ(scene.skins.size(), 1U);
    EXPECT_LT(glm::length(corner(scene, 4) - glm::vec3(-1, 1, 0)), 1e-6F);
    EXPECT_LT(glm::length(corner(posed_at(scene, 1.0), 4) - glm::vec3(-2, 1, 0)), 1e-6F);
}

TEST(GltfMorph, DeltasThatAreNotFiniteDoNotCount) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    GltfBuilder builder = face();
    builder.primitive()["targets"][0]["POSITION"] =
        builder.add_floats({0, 0, infinity, 0, 0, 2, std::nanf(""), 0, 3}, "VEC3", 3);
    builder.json["nodes"][0]["weights"] = {1, 0};
    const Scene scene = builder.read();
    EXPECT_TRUE(
        builder.warned("2 displacements by morph targets: not finite, zero is used instead; at "));
    EXPECT_EQ(corner(scene, 0), glm::vec3(0, 0, 0));
    EXPECT_EQ(corner(scene, 1), glm::vec3(1, 0, 2));
}

/// The error of a face with both targets in use, after one value is replaced.
std::string error_after(const char* pointer, const Json& value) {
    GltfBuilder builder = face();
    animate(builder, {0, 1}, {0, 0, 1, 1}, "LINEAR");
    builder.json["nodes"][0]["weights"] = {1, 1};
    EXPECT_EQ(builder.error(), "no error");
    builder.json[Json::json_pointer(pointer)] = value;
    return builder.error();
}

TEST(GltfMorph, RefusesWeightsOfAnotherNumber) {
    EXPECT_EQ(error_after("/nodes/0/weights", {1}),
              "#/nodes/0/weights: has 1 elements, expected as many as morph targets, 2");
    EXPECT_EQ(error_after("/meshes/0/weights", {1, 1, 1}),
              "#/meshes/0/weights: has 3 elements, expected as many as morph targets, 2");
    EXPECT_EQ(error_after("/nodes/0/weights", {1, "1"}),
              "#/nodes/0/weights/1: is of type string, expected a number");
    GltfBuilder none = GltfBuilder::triangle();
    none.json["nodes"][0]["weights"] = {1};
    EXPECT_EQ(none.error(),
              "#/nodes/0/weights: has 1 elements, expected as many as morph targets, 0");
    GltfBuilder endless = face();
    endless.json["nodes"][0]["weights"] = {1e300, 0};
    EXPECT_EQ(endless.error(), ": mesh 'mesh 0' has a vertex that is not finite");
}

TEST(GltfMorph, RefusesBrokenTargets) {
    const std::string at = "#/meshes/0/primitives/0/targets";
    EXPECT_EQ(error_after("/accessors/2/count", 2),
              at + "/1/POSITION: has 2 elements, expected as many as POSITION, 3");
    EXPECT_EQ(error_after("/accessors/2/type", "SCALAR"),
              at + "/1/POSITION: has 1 components, expected 3");
    EXPECT_EQ(error_after("/meshes/0/primitives/0/targets/1/POSITION", 9),
              at + "/1/POSITION: is 9, but there are only 5 accessors");
    EXPECT_EQ(error_after("/meshes/0/primitives/0/targets/1", 3),
              at + "/1: is of type number, expected an object");
    EXPECT_EQ(error_after("/meshes/0/primitives/0/targets", 3),
              at + ": is of type number, expected an array");
    GltfBuilder builder = face();
    builder.json["nodes"][0]["weights"] = {1, 0};
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
    EXPECT_EQ(builder.error(),
              "#/meshes/0/primitives/1: has 0 morph targets, expected as many as the first "
              "primitive, 2");
}

TEST(GltfMorph, RefusesEndlessTargetsBeforeReadingThem) {
    GltfBuilder builder = face();
    builder.primitive()["targets"] =
        std::vector<Json>(limits::max_morph_targets + 1, Json{{"POSITION", across}});
    EXPECT_EQ(builder.error(), "#/meshes/0/primitives/0/targets: has " +
                                   std::to_string(limits::max_morph_targets + 1) +
                                   " elements, expected at most " +
                                   std::to_string(limits::max_morph_targets));
    // Many samplers with few bytes would otherwise make many numbers.
    builder = face();
    animate(builder, {0}, {0, 0}, "LINEAR");
    builder.json["accessors"].push_back(
        {{"componentType", 5126}, {"type", "SCALAR"}, {"count", limits::max_animation_keys}});
    builder.json["animations"][0]["samplers"][0]["input"] = builder.json["accessors"].size() - 1;
    EXPECT_EQ(builder.error(),
              "#/animations/0/samplers/0/input: brings the file above the limit "
              "of " +
                  std::to_string(limits::max_animation_keys) + " animation keys");
}

TEST(GltfMorph, RefusesAnimationsOfTheWrongKind) {
    const std::string at = "#/animations/0/";
    EXPECT_EQ(error_after("/accessors/4/count", 3),
              at + "samplers/0/output: chooses 3 values, expected 2 for each of 2 keys");
    EXPECT_EQ(error_after("/animations/0/samplers/0/interpolation", "CUBICSPLINE"),
              at + "samplers/0/output: chooses 4 values, expected 6 for each of 2 keys");
    EXPECT_EQ(error_after("/animations/0/samplers/0/output", across),
              at + "samplers/0/output: chooses an accessor that holds no weights, expected SCALAR "
                   "of 5126 or of normalized integers");
    GltfBuilder nan = face();
    animate(nan, {0}, {0, std::nanf("")}, "LINEAR");
    EXPECT_EQ(nan.error(), at + "samplers/0/output: value 1 is not finite");
    // Two targets here and three there cannot share a sampler.
    GltfBuilder shared = face();
    animate(shared, {0}, {0, 0}, "LINEAR");
    shared.json["meshes"].push_back(shared.json["meshes"][0]);
    shared.json["meshes"][1]["primitives"][0]["targets"].push_back({{"POSITION", across}});
    shared.json["nodes"].push_back({{"mesh", 1}});
    Json channel = shared.json["animations"][0]["channels"][0];
    channel["target"]["node"] = 1;
    shared.json["animations"][0]["channels"].push_back(channel);
    EXPECT_EQ(shared.error(),
              at + "channels/1/sampler: sampler 0 has values for another kind of property as well");
}

}  // namespace
}  // namespace weft::gltf_morph_test
