// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_edits.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "scene/gltf/gltf_reader.h"
#include "scene/validate_scene.h"
#include "tests/testing/edited_room.h"

namespace weft::scene_edits_test {
namespace {

using test::Edited;
using test::placement;
using test::read_text;
using test::room;

void expect_near(const glm::dmat4& a, const glm::dmat4& b) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            EXPECT_NEAR(a[column][row], b[column][row], 1e-14) << column << ' ' << row;
}

TEST(SceneEdits, MoveByAShareOfTheWay) {
    const Edited edited(R"({"frame": 3, "until": 6, "object": "Box", "move": [4, 0, -8]})");
    EXPECT_EQ(edited.box_at(0), placement(2.0, {1, 2, 3}));
    EXPECT_EQ(edited.box_at(2), placement(2.0, {1, 2, 3}));
    EXPECT_EQ(edited.box_at(3), placement(2.0, {2, 2, 1}));
    EXPECT_EQ(edited.box_at(4), placement(2.0, {3, 2, -1}));
    EXPECT_EQ(edited.box_at(6), placement(2.0, {5, 2, -5}));
    EXPECT_EQ(edited.box_at(2147483647), placement(2.0, {5, 2, -5}));
    EXPECT_TRUE(edited.rest.instances[0].may_move);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_FALSE(edited.rest.instances[i].may_move);
}

TEST(SceneEdits, HappenAtOnceWithoutUntil) {
    const Edited edited(R"({"frame": 0, "object": "Box", "move": [1, 1, 1]})");
    EXPECT_EQ(edited.box_at(0), placement(2.0, {2, 3, 4}));
    EXPECT_EQ(edited.box_at(1), placement(2.0, {2, 3, 4}));
}

TEST(SceneEdits, TurnAboutTheObjectOrAPoint) {
    const Edited own(R"({"frame": 1, "until": 2, "object": "Box",
                         "rotate": {"axis": [0, 0, 1e300], "degrees": 180}})");
    // x goes to y and y to -x after half of it, both turn back after all of it.
    expect_near(own.box_at(1), {{0, 2, 0, 0}, {-2, 0, 0, 0}, {0, 0, 2, 0}, {1, 2, 3, 1}});
    expect_near(own.box_at(2), {{-2, 0, 0, 0}, {0, -2, 0, 0}, {0, 0, 2, 0}, {1, 2, 3, 1}});
    const Edited about(R"({"frame": 1, "object": "Box",
                           "rotate": {"axis": [0, 2, 0], "degrees": 90, "about": [1, 0, 1]}})");
    // z goes to x and x to -z: (0, 2, 2) from the point becomes (2, 2, 0).
    expect_near(about.box_at(1), {{0, 0, -2, 0}, {0, 2, 0, 0}, {2, 0, 0, 0}, {3, 2, 1, 1}});
}

TEST(SceneEdits, ScaleByAPowerOfTheFactorAboutTheObjectsOrigin) {
    const Edited even(R"({"frame": 1, "until": 2, "object": "Box", "scale": 4})");
    EXPECT_EQ(even.box_at(1), placement(4.0, {1, 2, 3}));
    EXPECT_EQ(even.box_at(2), placement(8.0, {1, 2, 3}));
    const Edited uneven(R"({"frame": 1, "object": "Box", "scale": [0.5, 1, 3]})");
    EXPECT_EQ(uneven.box_at(1), glm::dmat4({1, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 6, 0}, {1, 2, 3, 1}));
}

TEST(SceneEdits, ReachAllPartsOfAnObject) {
    const Edited edited(R"({"frame": 1, "object": "Wall", "move": [1, 0, 0]},
                           {"frame": 2, "object": "Wall", "remove": true})");
    const Scene scene = edited.at(1);
    for (const std::size_t part : {1U, 2U}) {
        EXPECT_EQ(scene.instances[part].to_world, placement(1.0, {1, 0, 0}));
        EXPECT_TRUE(scene.instances[part].present && scene.instances[part].may_move);
        EXPECT_FALSE(edited.at(2).instances[part].present);
    }
    EXPECT_EQ(scene.instances[0].to_world, room().instances[0].to_world);
}

TEST(SceneEdits, AddCopiesThatLaterEditsReach) {
    const Edited edited(R"(
        {"frame": 4, "object": "Wall", "add": {"name": "Wall 2", "translation": [1, 2, 3],
            "rotation": [0, 0, 1, 0], "scale": [2, 3, -4], "material": "Emissive"}},
        {"frame": 5, "object": "Wall 2", "move": [1, 0, 0]},
        {"frame": 6, "object": "Wall 2", "add": {"name": "Wall 3"}},
        {"frame": 7, "object": "Wall 2", "remove": true})");
    ASSERT_EQ(edited.rest.instances.size(), 8U);
    EXPECT_NO_THROW(validate_scene(edited.rest));
    const glm::dmat4 placed({-2, 0, 0, 0}, {0, -3, 0, 0}, {0, 0, -4, 0}, {1, 2, 3, 1});
    for (const std::size_t index : {4U, 5U}) {
        const Instance& copy = edited.rest.instances[index];
        EXPECT_EQ(copy.name, "Wall 2");
        EXPECT_EQ(copy.mesh, index - 3);
        EXPECT_EQ(copy.material, 1U);
        EXPECT_TRUE(copy.may_move);
        EXPECT_FALSE(copy.present);
        EXPECT_FALSE(edited.at(3).instances[index].present);
        EXPECT_TRUE(edited.at(4).instances[index].present);
        EXPECT_EQ(edited.at(4).instances[index].to_world, placed);
        EXPECT_EQ(edited.at(5).instances[index].to_world[3], glm::dvec4(2, 2, 3, 1));
        EXPECT_FALSE(edited.at(7).instances[index].present);
        EXPECT_TRUE(edited.at(7).instances[index + 2].present);
        EXPECT_EQ(edited.rest.instances[index + 2].to_world, glm::dmat4(1.0));
    }
    EXPECT_FALSE(edited.rest.instances[1].may_move);
    const Edited own(R"({"frame": 0, "object": "Wall", "add": {"name": "W"}})");
    EXPECT_EQ(own.rest.instances.at(4).material, 0U);
    EXPECT_EQ(own.rest.instances.at(5).material, 1U);
}

TEST(SceneEdits, CopyOneOfSeveralPlacesOfAName) {
    Scene scene = room();
    scene.instances[2].to_world = placement(1.0, {5, 5, 5});
    (void)read_text(R"({"edits": [{"frame": 0, "object": "Wall", "add": {"name": "W"}}]})", scene);
    ASSERT_EQ(scene.instances.size(), 5U);
    EXPECT_EQ(scene.instances[4].mesh, 1U);
}

TEST(SceneEdits, AddWhatWasRemovedUnderANewName) {
    const Edited edited(R"({"frame": 2, "object": "Box", "remove": true},
                           {"frame": 2, "object": "Box", "add": {"name": "B", "scale": [2,2,2]}})");
    EXPECT_FALSE(edited.at(2).instances[0].present);
    EXPECT_TRUE(edited.at(2).instances[4].present);
}

TEST(SceneEdits, ChangeLights) {
    const Edited edited(
        R"({"frame": 7, "until": 8, "light": "Bulb", "intensity": 0.5, "move": [0, -2, 0]},
           {"frame": 9, "light": "Bulb", "intensity": 0})");
    EXPECT_EQ(edited.at(6).lights[0].intensity, glm::vec3(8, 4, 2));
    EXPECT_EQ(edited.at(7).lights[0].intensity, glm::vec3(6, 3, 1.5));
    EXPECT_EQ(edited.at(7).lights[0].position, glm::dvec3(0, 4, 0));
    EXPECT_EQ(edited.at(8).lights[0].intensity, glm::vec3(4, 2, 1));
    EXPECT_EQ(edited.at(8).lights[0].position, glm::dvec3(0, 3, 0));
    EXPECT_EQ(edited.at(9).lights[0].intensity, glm::vec3(0.0F));
    EXPECT_EQ(edited.at(9).lights[1].intensity, glm::vec3(1.0F));
}

TEST(SceneEdits, ChangeMaterials) {
    const Edited edited(R"(
        {"frame": 1, "until": 2, "material": "Red", "albedo": [0, 0.75, 1], "emission": [2, 4, 0]},
        {"frame": 3, "until": 4, "material": "Emissive", "emission_factor": 0},
        {"frame": 5, "material": "Emissive", "emission": [1, 2, 3], "emission_factor": 3})");
    EXPECT_EQ(diffuse_albedo(edited.at(1).materials[0]), glm::vec3(0.4F, 0.5F, 0.5F));
    EXPECT_EQ(edited.at(1).materials[0].emission.radiance, glm::vec3(1, 2, 0));
    EXPECT_EQ(diffuse_albedo(edited.at(2).materials[0]), glm::vec3(0, 0.75F, 1));
    EXPECT_EQ(edited.at(2).materials[0].emission.radiance, glm::vec3(2, 4, 0));
    EXPECT_EQ(edited.at(3).materials[1].emission.radiance, glm::vec3(2, 1, 0.5F));
    EXPECT_EQ(edited.at(4).materials[1].emission.radiance, glm::vec3(0.0F));
    EXPECT_EQ(edited.at(5).materials[1].emission.radiance, glm::vec3(3, 6, 9));
    EXPECT_EQ(diffuse_albedo(edited.at(5).materials[1]), glm::vec3(0.5F));
    for (const Instance& instance : edited.rest.instances) EXPECT_FALSE(instance.may_move);
}

TEST(SceneEdits, ChangeTheRoughnessOfSurfacesThatHaveOne) {
    Scene scene = room();
    ConductorSurface mirror;
    mirror.roughness_u.value.factor = mirror.roughness_v.value.factor = 0.25F;
    scene.materials[0].description = SurfaceDescription{mirror, {}, {}};
    const EditTimeline timeline = read_text(
        R"({"edits": [{"frame": 1, "until": 2, "material": "Red", "roughness": 0.1}]})", scene);
    const auto alphas = [&](std::uint32_t frame) {
        Scene at = scene;
        apply_edits(timeline, frame, at);
        const auto& surface = std::get<ConductorSurface>(at.materials[0].description->model);
        return glm::vec2(surface.roughness_u.value.factor, surface.roughness_v.value.factor);
    };
    // The file's scale is alpha, the square of the roughness, which was 0.5.
    EXPECT_EQ(alphas(0), glm::vec2(0.25F));
    EXPECT_NEAR(alphas(1).x, 0.09F, 1e-7F);
    EXPECT_NEAR(alphas(2).x, 0.01F, 1e-7F);
    EXPECT_EQ(alphas(2).x, alphas(2).y);
    // Each direction changes evenly from its own.
    auto& surface = std::get<ConductorSurface>(scene.materials[0].description->model);
    surface.roughness_v.value.factor = 0.81F;
    EXPECT_NEAR(alphas(1).x, 0.09F, 1e-7F);
    EXPECT_NEAR(alphas(1).y, 0.25F, 1e-7F);
    EXPECT_EQ(alphas(2).x, alphas(2).y);
}

TEST(SceneEdits, ChangeRoughnessOnTheScaleOfTheFile) {
    const auto factor = [&](RoughnessScale scale, float before, const char* roughness) {
        Scene scene = room();
        scene.materials[0].description = SurfaceDescription{
            SpecularSurface{.roughness = {ScalarParameter{before}, scale}}, {}, {}};
        const EditTimeline timeline =
            read_text(R"({"edits": [{"frame": 0, "material": "Red", "roughness": )" +
                          std::string(roughness) + "}]}",
                      scene);
        apply_edits(timeline, 0, scene);
        const auto& surface = std::get<SpecularSurface>(scene.materials[0].description->model);
        EXPECT_NEAR(*perceived_roughness(scene.materials[0]), std::stod(roughness), 0.02);
        return surface.roughness.value.factor;
    };
    EXPECT_EQ(factor(RoughnessScale::roughness, 0.5F, "0.2"), 0.2F);
    EXPECT_EQ(factor(RoughnessScale::glossiness, 0.5F, "0.2"), 0.8F);
    EXPECT_NEAR(factor(RoughnessScale::alpha, 0.5F, "0.2"), 0.04F, 1e-8F);
    EXPECT_NEAR(factor(RoughnessScale::exponent, 10.0F, "0.5"), 30.0F, 1e-5F);
    EXPECT_EQ(factor(RoughnessScale::exponent, 10.0F, "1"), 0.0F);
    EXPECT_EQ(factor(RoughnessScale::exponent, 10.0F, "0"), 1e8F) << "smooth, but finite";
}

TEST(SceneEdits, ChangeNoRoughnessOfScenesReadAsDiffuse) {
    Scene scene = room();
    scene.detail = MaterialDetail::diffuse;
    const EditTimeline timeline =
        read_text(R"({"edits": [{"frame": 0, "material": "Red", "roughness": 0.1}]})", scene);
    apply_edits(timeline, 0, scene);
    EXPECT_FALSE(scene.materials[0].description);
}

TEST(SceneEdits, GoByFrameThenByOrderInTheFile) {
    const std::string turn =
        R"("object": "Box", "rotate": {"axis": [0, 0, 1], "degrees": 90, "about": [0, 0, 0]}})";
    const std::string move = R"("object": "Box", "move": [5, 0, 0]})";
    const Edited first(R"({"frame": 2, )" + turn + R"(, {"frame": 2, )" + move);
    const Edited second(R"({"frame": 2, )" + move + R"(, {"frame": 2, )" + turn);
    const Edited late(R"({"frame": 3, )" + turn + R"(, {"frame": 2, )" + move);
    const auto place = [](const Edited& edited) { return glm::dvec3(edited.box_at(3)[3]); };
    EXPECT_LE(glm::length(place(first) - glm::dvec3(3, 1, 3)), 1e-14);
    EXPECT_LE(glm::length(place(second) - glm::dvec3(-2, 6, 3)), 1e-14);
    EXPECT_EQ(late.box_at(3), second.box_at(3));
    EXPECT_NE(late.timeline.edits[0].place.find("#/edits/1/move"), std::string::npos);
}

TEST(SceneEdits, AreTheSameInAnyOrderOfFrames) {
    const Edited edited(R"(
        {"frame": 1, "until": 7, "object": "Box", "move": [0.1, 0.2, 0.3]},
        {"frame": 2, "until": 5, "object": "Box", "rotate": {"axis": [1, 2, 3], "degrees": 77}},
        {"frame": 3, "until": 9, "object": "Box", "scale": [0.3, 1.7, 1]},
        {"frame": 4, "until": 8, "material": "Red", "albedo": [0.1, 0.2, 0.3]})");
    std::vector<Scene> forwards;
    for (std::uint32_t frame = 0; frame < 12; ++frame) forwards.push_back(edited.at(frame));
    for (std::uint32_t frame = 12; frame-- > 0;) {
        const Scene again = edited.at(frame);
        EXPECT_EQ(again.instances[0].to_world, forwards[frame].instances[0].to_world);
        EXPECT_EQ(diffuse_albedo(again.materials[0]), diffuse_albedo(forwards[frame].materials[0]));
    }
    EXPECT_NE(forwards[4].instances[0].to_world, forwards[5].instances[0].to_world);
}

TEST(SceneEdits, MayBeNone) {
    const Edited none("");
    EXPECT_TRUE(none.timeline.edits.empty());
    EXPECT_EQ(none.box_at(5), room().instances[0].to_world);
}

TEST(SceneEdits, ReadTheExampleOfTheirPage) {
    const std::string folder = WEFT_SOURCE_DIR;
    std::ifstream in(folder + "/docs/edits.md");
    const std::string page(std::istreambuf_iterator<char>(in), {});
    const std::string fence = "```json\n";
    const std::size_t start = page.find(fence);
    ASSERT_NE(start, std::string::npos);
    const std::size_t text = start + fence.size();
    Diagnostics ignored;
    Scene box = read_gltf(folder + "/scenes/cornell-box.gltf", ignored);
    const std::string example = page.substr(text, page.find("```", text) - text);
    std::ifstream shipped(folder + "/scenes/cornell-box-edits.json");
    EXPECT_EQ(example, std::string(std::istreambuf_iterator<char>(shipped), {}));
    const EditTimeline timeline = read_text(example, box);
    EXPECT_EQ(timeline.edits.size(), 7U);
    for (std::uint32_t frame = 0; frame < 30; ++frame) {
        Scene scene = box;
        EXPECT_NO_THROW(apply_edits(timeline, frame, scene)) << frame;
        EXPECT_NO_THROW(validate_scene(scene)) << frame;
    }
}

}  // namespace
}  // namespace weft::scene_edits_test
