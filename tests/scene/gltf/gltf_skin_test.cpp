// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "scene/moving_scene.h"
#include "scene/pose_scene.h"
#include "tests/testing/gltf_limb.h"

namespace weft::gltf_skin_test {
namespace {

using Json = nlohmann::json;
using test::Limb;

constexpr float quarter = 0.70710678F;  // sine and cosine of half a right angle

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LE(glm::length(a - b), 1e-6)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// Where a vertex of an instance is in the world.
glm::dvec3 vertex(const Scene& scene, std::size_t instance, std::size_t index) {
    const Instance& placed = scene.instances.at(instance);
    const glm::dvec3 position(scene.meshes.at(placed.mesh).positions.at(index));
    return glm::dvec3(placed.to_world * glm::dvec4(position, 1.0));
}

Scene posed_at(const Scene& scene, double time) {
    Scene posed = scene;
    pose_scene(scene, time, posed);
    return posed;
}

TEST(GltfSkin, RestsInItsBindPoseAndPaysNothing) {
    Limb limb;
    const Scene scene = limb.read();
    EXPECT_TRUE(limb.diagnostics.warnings().empty());
    ASSERT_EQ(scene.instances.size(), 1U);
    ASSERT_EQ(scene.meshes.size(), 1U);
    // Where the skeleton stands, not where the node of the mesh is.
    expect_near(vertex(scene, 0, 0), {0, 0, 5});
    expect_near(vertex(scene, 0, 5), {1, 2, 5});
    EXPECT_EQ(glm::dvec3(scene.instances[0].to_world[3]), glm::dvec3(0, 0, 5));
    EXPECT_FALSE(scene.instances[0].may_move);
    EXPECT_EQ(scene.instances[0].deformation, -1);
    EXPECT_TRUE(scene.deformations.empty());
    EXPECT_TRUE(scene.skins.empty());
    EXPECT_FALSE(is_animated(scene));
}

TEST(GltfSkin, APoseAtRestThatIsNotTheBindPoseIsTakenOnce) {
    Limb limb;
    limb.json["nodes"][Limb::tip]["rotation"] = {0, 0, quarter, quarter};
    const Scene scene = limb.read();
    EXPECT_FALSE(is_animated(scene));
    expect_near(vertex(scene, 0, 1), {1, 0, 5});
    expect_near(vertex(scene, 0, 4), {-1, 1, 5});
    expect_near(vertex(scene, 0, 5), {-1, 2, 5});
    // Half of (1, 1) and of (0, 2).
    expect_near(vertex(scene, 0, 3), {0.5, 1.5, 5});
    EXPECT_EQ(scene.meshes[0].triangles.size(), 4U);
}

TEST(GltfSkin, WithoutMatricesJointsBindInTheirOwnSpace) {
    Limb limb;
    limb.json["skins"][0].erase("inverseBindMatrices");
    const Scene scene = limb.read();
    expect_near(vertex(scene, 0, 1), {1, 0, 5});
    expect_near(vertex(scene, 0, 5), {1, 3, 5});
    expect_near(vertex(scene, 0, 3), {1, 1.5, 5});
}

TEST(GltfSkin, FollowsItsJointsOverTime) {
    Limb limb;
    limb.animate(Limb::tip, "rotation", {0, 2}, {0, 0, 0, 1, 0, 0, quarter, quarter});
    const Scene scene = limb.read();
    ASSERT_EQ(scene.deformations.size(), 1U);
    EXPECT_TRUE(scene.instances[0].may_move);
    EXPECT_TRUE(is_animated(scene));
    expect_near(vertex(scene, 0, 4), {0, 2, 5});
    const Scene half = posed_at(scene, 1.0);
    expect_near(vertex(half, 0, 4), {-std::sqrt(0.5), 1.0 + std::sqrt(0.5), 5});
    expect_near(vertex(half, 0, 0), {0, 0, 5});
    const Scene end = posed_at(scene, 2.0);
    expect_near(vertex(end, 0, 4), {-1, 1, 5});
    EXPECT_EQ(glm::vec3(0, 0, 1), end.meshes[0].normals[4]);
    // At rest again, and without what it is made of.
    Scene held = scene;
    hold_still(held);
    EXPECT_FALSE(is_animated(held));
    EXPECT_FALSE(held.instances[0].may_move);
    validate_scene(held);
}

TEST(GltfSkin, WhatCarriesTheWholeSkeletonMovesItAsOneThing) {
    Limb limb;
    limb.animate(Limb::stand, "translation", {0, 1}, {0, 0, 5, 4, 0, 5});
    const Scene scene = limb.read();
    EXPECT_TRUE(scene.deformations.empty());
    EXPECT_TRUE(scene.instances[0].may_move);
    expect_near(vertex(posed_at(scene, 0.5), 0, 5), {3, 2, 5});
    Limb both = limb;
    both.animate(Limb::root, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    expect_near(vertex(posed_at(both.read(), 1.0), 0, 5), {6, 4, 5});
}

TEST(GltfSkin, TheNodeOfTheMeshDoesNotCount) {
    Limb limb;
    limb.json["nodes"][Limb::limb]["scale"] = {0, 0, 0};
    EXPECT_EQ(limb.read().instances.size(), 1U);
    EXPECT_TRUE(limb.diagnostics.warnings().empty());
    limb.animate(Limb::limb, "translation", {0, 1}, {0, 0, 0, 9, 9, 9});
    const Scene scene = limb.read();
    EXPECT_FALSE(is_animated(scene));
    expect_near(vertex(scene, 0, 5), {1, 2, 5});
}

TEST(GltfSkin, OneMeshMayHaveSeveralSkins) {
    Limb limb;
    limb.json["nodes"].push_back({{"children", {5}}, {"translation", {0, 0, -3}}});
    limb.json["nodes"].push_back({{"children", {6}}});
    limb.json["nodes"].push_back({{"translation", {0, 2, 0}}});
    limb.json["nodes"].push_back({{"mesh", 0}, {"skin", 1}});
    limb.json["nodes"].push_back({{"mesh", 0}, {"skin", 1}});
    limb.json["skins"].push_back({{"joints", {5, 6}}, {"inverseBindMatrices", Limb::matrices}});
    limb.json["scenes"][0]["nodes"] = {0, 1, 4, 7, 8};
    limb.animate(6, "translation", {0, 1}, {0, 2, 0, 0, 3, 0});
    const Scene scene = limb.read();
    ASSERT_EQ(scene.instances.size(), 3U);
    // Those that share a skin share what it makes.
    EXPECT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.deformations.size(), 1U);
    EXPECT_EQ(scene.instances[1].mesh, scene.instances[2].mesh);
    const Scene posed = posed_at(scene, 1.0);
    expect_near(vertex(posed, 0, 5), {1, 2, 5});
    expect_near(vertex(posed, 1, 5), {1, 4, -3});
    expect_near(vertex(posed, 2, 5), {1, 4, -3});
    EXPECT_FALSE(posed.instances[0].may_move);
    EXPECT_TRUE(posed.instances[2].may_move);
}

TEST(GltfSkin, StandsInTheNearestNodeAboveAllJoints) {
    Limb limb;
    // Two joints side by side below the root, which is none.
    limb.json["nodes"][Limb::root]["children"] = {3, 4};
    limb.json["nodes"][Limb::root]["translation"] = {1, 0, 0};
    limb.json["nodes"].push_back(Json::object());
    limb.json["skins"][0]["joints"] = {4, Limb::tip};
    EXPECT_EQ(glm::dvec3(limb.read().instances[0].to_world[3]), glm::dvec3(1, 0, 5));
    // In different trees.
    limb.json["nodes"][Limb::root]["children"] = {3};
    limb.json["scenes"][0]["nodes"] = {0, 1, 4};
    EXPECT_EQ(limb.read().instances[0].to_world, glm::dmat4(1.0));
}

TEST(GltfSkin, ReadsIntegersAndFurtherSets) {
    Limb limb;
    Json& attributes = limb.primitive()["attributes"];
    const std::size_t joints = limb.add_accessor<std::uint16_t>(
        {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5123, "VEC4", 6);
    const std::size_t weights = limb.add_accessor<std::uint8_t>(
        {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}, 5121, "VEC4",
        6);
    limb.json["accessors"][weights]["normalized"] = true;
    limb.json["nodes"][Limb::tip]["translation"] = {0, 3, 0};
    attributes["JOINTS_1"] = joints;
    attributes["WEIGHTS_1"] = weights;
    // The upper end belongs to the root in one set and to the tip in the other, which is said too.
    limb.json["accessors"][Limb::joints] = limb.json["accessors"][joints];
    limb.json["accessors"][Limb::joints]["bufferView"] = limb.add_view<std::uint16_t>(
        {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const Scene scene = limb.read();
    EXPECT_TRUE(limb.warned(
        "2 vertices: joint weights have a sum that is not 1, they are normalised; at "));
    expect_near(vertex(scene, 0, 0), {0, 0, 5});
    expect_near(vertex(scene, 0, 2), {0, 2, 5});
    expect_near(vertex(scene, 0, 4), {0, 3, 5});
}

TEST(GltfSkin, RepairsWeights) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Limb limb;
    limb.json["nodes"][Limb::tip]["translation"] = {0, 3, 0};
    limb.json["accessors"][Limb::weights]["bufferView"] =
        limb.add_view<float>({nan,  0,    0, 0, 1, -1, infinity, 0, 0.5F, 0.5F, 0, 0,
                              0.7F, 0.7F, 0, 0, 0, 0,  0,        0, 3,    0,    0, 0});
    const Scene scene = limb.read();
    EXPECT_TRUE(limb.warned("3 joint weights: negative or not finite, zero is used instead; at "));
    EXPECT_TRUE(limb.warned(
        "2 vertices: joint weights have a sum that is not 1, they are normalised; at "));
    EXPECT_TRUE(
        limb.warned("2 vertices: joint weights are missing, the first joint is followed; at "));
    expect_near(vertex(scene, 0, 0), {0, 0, 5});
    expect_near(vertex(scene, 0, 1), {1, 0, 5});
    expect_near(vertex(scene, 0, 3), {1, 2, 5});
    expect_near(vertex(scene, 0, 4), {0, 4, 5});
    expect_near(vertex(scene, 0, 5), {1, 4, 5});
}

TEST(GltfSkin, MirroringJointsLeaveTheOutsideOutside) {
    Limb limb;
    limb.json["nodes"][Limb::root]["scale"] = {-1, 1, 1};
    const Scene scene = limb.read();
    expect_near(vertex(scene, 0, 1), {-1, 0, 5});
    const auto facing = [](const Scene& flattened) {
        const FlatScene flat = flatten(flattened);
        const shared::Triangle& t = flat.triangles.at(0);
        const auto corner = [&](std::uint32_t i) {
            return glm::dvec3(flat.positions[i].x, flat.positions[i].y, flat.positions[i].z);
        };
        const glm::dvec3 normal =
            glm::cross(corner(t.v1) - corner(t.v0), corner(t.v2) - corner(t.v0));
        EXPECT_GT(normal.z * static_cast<double>(flat.normals.at(2)), 0.0);
        return normal.z;
    };
    EXPECT_GT(facing(scene), 0.0);
    // One that mirrors the frame does so for all that is in it.
    Limb frame;
    frame.json["nodes"][Limb::stand]["scale"] = {-1, 1, 1};
    EXPECT_GT(facing(frame.read()), 0.0);
    Limb turning;
    turning.animate(Limb::root, "scale", {0, 1}, {1, 1, 1, -1, 1, 1}, "STEP");
    const Scene before = turning.read();
    EXPECT_GT(facing(posed_at(before, 0.0)), 0.0);
    EXPECT_GT(facing(posed_at(before, 1.0)), 0.0);
}

TEST(GltfSkin, MeshesWithoutJointsAreRenderedUnskinned) {
    Limb limb;
    limb.primitive()["attributes"].erase("WEIGHTS_0");
    const Scene scene = limb.read();
    EXPECT_TRUE(limb.warned_at(
        "#/nodes/0", "the skin needs JOINTS_0 and WEIGHTS_0 of the mesh, it is left out"));
    expect_near(vertex(scene, 0, 0), {7, 7, 7});
}

TEST(GltfSkin, ASkeletonOfScaleZeroHidesWhatItCarries) {
    Limb limb;
    limb.json["nodes"][Limb::stand]["scale"] = {0, 0, 0};
    EXPECT_TRUE(limb.read().instances.empty());
    EXPECT_TRUE(limb.warned("the transform is singular (a scale of zero), the object is left out"));
}

/// The error of frame 1, at 1 s.
std::string error_of_frame(Limb& limb) {
    MovingScene moving(limb.read(), {}, 1.0);
    moving.set_frame(0);
    try {
        moving.set_frame(1);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        const std::string message = error.what();
        return message.substr(message.find(": ") + 2);
    }
    return "no error";
}

TEST(GltfSkin, UnusablePosesAreErrorsOfTheirFrames) {
    Limb vanishing;
    vanishing.animate(Limb::stand, "scale", {0, 1}, {1, 1, 1, 0, 0, 0}, "STEP");
    vanishing.animate(Limb::tip, "scale", {0, 1}, {1, 1, 1, 2, 2, 2}, "STEP");
    EXPECT_EQ(error_of_frame(vanishing),
              "instance 'limb' in frame 1 has a transform that cannot be inverted");
    Limb exploding;
    exploding.animate(Limb::root, "scale", {0, 1}, {1, 1, 1, 3e38F, 3e38F, 3e38F}, "STEP");
    exploding.animate(Limb::tip, "scale", {0, 1}, {1, 1, 1, 3e38F, 3e38F, 3e38F}, "STEP");
    EXPECT_EQ(error_of_frame(exploding),
              "instance 'limb' in frame 1 has a vertex that is not finite");
    Limb far;
    far.animate(Limb::tip, "translation", {0, 1}, {0, 1, 0, 0, 1e16F, 0}, "STEP");
    EXPECT_EQ(error_of_frame(far), "instance 'limb' in frame 1 lies too far from the origin");
    // A joint may vanish: what it carries becomes a point.
    Limb hidden;
    hidden.animate(Limb::tip, "scale", {0, 1}, {1, 1, 1, 0, 0, 0}, "STEP");
    EXPECT_EQ(error_of_frame(hidden), "no error");
}

/// The error after one value of a good file is replaced.
std::string error_after(const char* pointer, const Json& value) {
    Limb limb;
    limb.json[Json::json_pointer(pointer)] = value;
    return limb.error();
}

TEST(GltfSkin, RefusesBrokenSkins) {
    EXPECT_EQ(error_after("/nodes/0/skin", 1), "#/nodes/0/skin: is 1, but there are only 1 skins");
    EXPECT_EQ(error_after("/skins/0", Json::object()),
              "#/skins/0: lacks 'joints', which is required");
    EXPECT_EQ(error_after("/skins/0/joints", Json::array()),
              "#/skins/0/joints: has 0 elements, expected 1 to 65536");
    EXPECT_EQ(error_after("/skins/0/joints", std::vector<int>(65537, 2)),
              "#/skins/0/joints: has 65537 elements, expected 1 to 65536");
    EXPECT_EQ(error_after("/skins/0/joints/1", 4),
              "#/skins/0/joints/1: is 4, but there are only 4 nodes");
    EXPECT_EQ(error_after("/skins/0/skeleton", 9),
              "#/skins/0/skeleton: is 9, but there are only 4 nodes");
    EXPECT_EQ(error_after("/skins/0/joints", {2}),
              "#/nodes/0/skin: chooses a skin of 1 joints, but the mesh refers to joint 1");
    EXPECT_EQ(error_after("/scenes/0/nodes", {0}),
              "#/skins/0/joints/0: node 2 is not part of the scene that is rendered");
    EXPECT_EQ(error_after("/nodes/3/children", {2}),
              "#/nodes/3/children/0: node 2 is already a child of node 1, expected one parent");
    EXPECT_EQ(error_after("/nodes/3/scale", {1e308, 1e308, 1e308}),
              ": mesh 'mesh 0' has a vertex "
              "that is not finite");
    Limb far;
    far.json["nodes"][Limb::stand]["scale"] = {1e200, 1, 1};
    far.json["nodes"][Limb::root]["scale"] = {1e200, 1, 1};
    EXPECT_EQ(far.error(),
              "#/skins/0/joints/0: the transform of node 2 to world space is not finite");
}

TEST(GltfSkin, RefusesMatricesThatAreNone) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string at = "#/skins/0/inverseBindMatrices: ";
    EXPECT_EQ(error_after("/skins/0/inverseBindMatrices", Limb::weights),
              at + "chooses an accessor that holds no matrices, expected MAT4 of 5126");
    EXPECT_EQ(error_after("/accessors/4/count", 1),
              at + "chooses 1 matrices, expected one for each of 2 joints");
    EXPECT_EQ(error_after("/accessors/4/count", 3),
              "#/accessors/4: needs 192 bytes from byte 0, but the bufferView has only 128");
    Limb limb;
    std::vector<float> matrices(32, 0.0F);
    for (const std::size_t i : {0, 5, 10, 15, 16, 21, 26, 31}) matrices[i] = 1.0F;
    const auto error_with = [&](std::size_t index, float value) {
        std::vector<float> changed = matrices;
        changed[index] = value;
        limb.json["skins"][0]["inverseBindMatrices"] = limb.add_floats(changed, "MAT4", 16);
        return limb.error();
    };
    EXPECT_EQ(error_with(17, 0.0F), "no error");
    EXPECT_EQ(error_with(17, nan), at + "matrix 1 is not finite");
    EXPECT_EQ(error_with(3, 1.0F),
              at + "matrix 0 is not affine, expected 0, 0, 0, 1 as its last row");
    EXPECT_EQ(error_with(31, 0.0F),
              at + "matrix 1 is not affine, expected 0, 0, 0, 1 as its last row");
    // What it flattens stays flat.
    EXPECT_EQ(error_with(0, 0.0F), "no error");
}

TEST(GltfSkin, RefusesJointsAndWeightsOfTheWrongKind) {
    const std::string at = "#/meshes/0/primitives/0/attributes/";
    const auto error_of = [](const char* attribute, std::size_t accessor) {
        return error_after((std::string("/meshes/0/primitives/0/attributes/") + attribute).c_str(),
                           accessor);
    };
    EXPECT_EQ(error_of("JOINTS_0", Limb::weights),
              at + "JOINTS_0: chooses an accessor that holds no joints, expected VEC4 of 5121 or "
                   "5123");
    EXPECT_EQ(error_of("WEIGHTS_0", Limb::joints),
              at + "WEIGHTS_0: chooses an accessor that holds no weights, expected VEC4 of 5126 or "
                   "of normalized 5121 or 5123");
    EXPECT_EQ(error_of("JOINTS_0", Limb::positions), at + "JOINTS_0: has 3 components, expected 4");
    EXPECT_EQ(error_after("/accessors/2/count", 5),
              at + "JOINTS_0: has 5 elements, expected as many as POSITION, 6");
    EXPECT_EQ(error_after("/accessors/3/count", 7),
              "#/accessors/3: needs 112 bytes from byte 0, but the bufferView has only 96");
}

TEST(GltfSkin, MirroredBoundariesKeepTheirInside) {
    for (const double side : {1.0, -1.0}) {
        Limb limb;
        limb.json["nodes"][Limb::root]["scale"] = {side, 1, 1};
        limb.json["materials"] = {
            {{"extensions",
              {{"WEFT_medium", {{"absorption", {1, 1, 1}}, {"scattering", {1, 1, 1}}}}}}}};
        limb.json["extensionsUsed"] = {"WEFT_medium"};
        limb.primitive()["material"] = 0;
        const Scene scene = limb.read();
        ASSERT_EQ(scene.medium_boundaries.size(), 1U);
        EXPECT_EQ(scene.medium_boundaries[0].interior, side > 0.0 ? 0 : -1);
        EXPECT_EQ(scene.medium_boundaries[0].exterior, side > 0.0 ? -1 : 0);
    }
}

}  // namespace
}  // namespace weft::gltf_skin_test
