// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/info_json.h"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/info_text.h"
#include "base/shorten.h"
#include "base/warning_collector.h"
#include "scene/default_light.h"
#include "tests/testing/environment_images.h"
#include "tests/testing/scene_builder.h"

namespace weft::info_json_test {
namespace {

using nlohmann::json;

constexpr double pi = std::numbers::pi;

/// A white square of 2 x 3 in the plane z = 1, with an object-space size of half of that.
test::SceneBuilder square() {
    test::SceneBuilder builder;
    builder.add(test::quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1.5F, 0}),
                builder.material(glm::vec3(1.0F)), test::placement(2.0, {-1.0, 5.0, 1.0}));
    return builder;
}

json info_of(const Scene& scene) {
    Diagnostics diagnostics;
    return info_json(scene, diagnostics);
}

/// The rows of the text that begin with this label, up to the next label.
std::string rows(const std::string& text, const std::string& label) {
    const std::size_t begin = text.find("\n" + label);
    if (begin == std::string::npos) return "";
    std::size_t end = begin + 1;
    do end = text.find('\n', end) + 1;
    while (end < text.size() && text[end] == ' ');
    return text.substr(begin + 1, end - begin - 1);
}

TEST(InfoJson, BoundsAreThoseOfWhatIsPlaced) {
    const json bounds = info_of(square().scene)["bounds"];
    EXPECT_EQ(bounds["low"], json({-1.0, 5.0, 1.0}));
    EXPECT_EQ(bounds["high"], json({1.0, 8.0, 1.0}));
    EXPECT_EQ(bounds["size"], json({2.0, 3.0, 0.0}));
    EXPECT_TRUE(info_of(Scene{})["bounds"].is_null());
    EXPECT_NE(info_text(info_of(Scene{})).find("nothing is placed"), std::string::npos);
}

TEST(InfoJson, CamerasHaveTheirFieldOfViewAndAFallbackIsMarked) {
    test::SceneBuilder builder = square();
    const json fallback = info_of(builder.scene)["camera_list"];
    ASSERT_EQ(fallback.size(), 1U);
    EXPECT_EQ(fallback[0]["fallback"], true);
    EXPECT_TRUE(info_of(builder.scene)["cameras"].empty()) << "those of the file";
    EXPECT_NE(rows(info_text(info_of(builder.scene)), "cameras").find("added by Weft"),
              std::string::npos);
    builder.scene.cameras.push_back(test::look_at({0, 0, 9}, {0, 0, 0}, pi / 3.0));
    builder.scene.cameras.back().name = "eye";
    builder.scene.cameras.push_back(builder.scene.cameras.back());
    builder.scene.cameras.back().fov_axis = FovAxis::x;
    builder.scene.cameras.back().motion.node = 0;
    builder.scene.animation.nodes.emplace_back();
    const json list = info_of(builder.scene)["camera_list"];
    ASSERT_EQ(list.size(), 2U);
    EXPECT_EQ(list[0]["name"], "eye");
    EXPECT_EQ(list[0]["kind"], "perspective");
    EXPECT_NEAR(list[0]["field_of_view"].get<double>(), 60.0, 1e-9);
    EXPECT_EQ(list[0]["field_of_view_axis"], "vertical");
    EXPECT_EQ(list[0]["fallback"], false);
    EXPECT_EQ(list[0]["animated"], false);
    EXPECT_EQ(list[1]["field_of_view_axis"], "horizontal");
    EXPECT_EQ(list[1]["animated"], true);
    EXPECT_EQ(rows(info_text(info_of(builder.scene)), "cameras"),
              "cameras       eye  perspective, 60 degrees (vertical)\n"
              "              eye  perspective, 60 degrees (horizontal), animated\n");
}

TEST(InfoJson, LightsHaveTheirPower) {
    test::SceneBuilder builder = square();
    builder.add(test::quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                builder.material(glm::vec3(0.0F), {3.0F, 2.0F, 1.0F}),
                test::placement(2.0, {0.0, 0.0, 4.0}));
    builder.scene.instances.back().name = "lamp";
    builder.light(LightType::point, {0, 0, 2}, glm::vec3(5.0F)).name = "bulb";
    PunctualLight& spot = builder.light(LightType::spot, {0, 0, 2}, glm::vec3(1.0F));
    spot.cos_inner = 1.0F;
    spot.cos_outer = 0.25F;
    builder.light(LightType::directional, {0, 0, 0}, {1.0F, 2.0F, 3.0F}).name = "sun";
    builder.light(LightType::point, {0, 0, 2}, glm::vec3(0.0F)).name = "off";
    builder.scene.environment = Environment{glm::vec3(0.5F)};
    const json list = info_of(builder.scene)["light_list"];
    ASSERT_EQ(list.size(), 5U);
    EXPECT_EQ(list[0]["name"], "lamp");
    EXPECT_EQ(list[0]["kind"], "area");
    EXPECT_EQ(list[0]["triangles"], 2);
    EXPECT_NEAR(list[0]["area"].get<double>(), 4.0, 1e-5);
    EXPECT_NEAR(list[0]["power"][0].get<double>(), 12.0 * pi, 1e-4);
    EXPECT_NEAR(list[0]["power"][2].get<double>(), 4.0 * pi, 1e-4);
    EXPECT_EQ(list[1]["kind"], "point");
    EXPECT_NEAR(list[1]["power"][1].get<double>(), 20.0 * pi, 1e-4);
    EXPECT_EQ(list[1]["unit"], "W");
    // The integral of ((c - 1/4) / (3/4))^2 over the cosines from 1/4 to 1 is 1/4.
    EXPECT_EQ(list[2]["kind"], "spot");
    EXPECT_NEAR(list[2]["power"][0].get<double>(), 0.5 * pi, 1e-5);
    EXPECT_EQ(list[3]["kind"], "directional");
    EXPECT_EQ(list[3]["power"], json({1.0, 2.0, 3.0}));
    EXPECT_EQ(list[3]["unit"], "W/m^2");
    EXPECT_EQ(list[4]["kind"], "environment");
    EXPECT_EQ(list[4]["unit"], "W/(m^2 sr)");
    for (const json& light : list) EXPECT_EQ(light["default"], false);
    const std::string text = rows(info_text(info_of(builder.scene)), "lights");
    EXPECT_NE(text.find("lamp         area, RGB 37.7 25.1 12.6 W, 2 triangles\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("bulb         point, 62.8 W\n"), std::string::npos) << text;
}

TEST(InfoJson, SpotsOfALinearEdgeHaveTheirPower) {
    test::SceneBuilder builder = square();
    PunctualLight& spot = builder.light(LightType::spot, {0, 0, 2}, glm::vec3(1.0F));
    spot.cos_inner = 1.0F;
    spot.cos_outer = 0.0F;
    spot.linear_edge = true;
    // The integral of (1 - 2 a / pi) sin a over the angles from 0 to pi / 2 is 1 - 2 / pi.
    const json list = info_of(builder.scene)["light_list"];
    EXPECT_NEAR(list[0]["power"][0].get<double>(), 2.0 * pi * (1.0 - 2.0 / pi), 1e-5);
}

TEST(InfoJson, LargeNumbersHaveNoExponent) {
    test::SceneBuilder builder = square();
    builder.scene.instances[0].to_world = test::placement(25190.0, {0.0, 0.0, 0.0});
    builder.light(LightType::directional, {0, 0, 0}, {1063.0F, 884.0F, 0.00125F}).name = "sun";
    builder.light(LightType::directional, {0, 0, 0}, glm::vec3(3e9F)).name = "flash";
    const std::string text = info_text(info_of(builder.scene));
    EXPECT_EQ(rows(text, "size"), "size          25190 x 37785 x 0 scene units\n");
    EXPECT_NE(text.find("sun    directional, RGB 1063 884 0.00125 W/m^2\n"), std::string::npos)
        << text;
    EXPECT_NE(text.find("flash  directional, 3e+09 W/m^2\n"), std::string::npos) << text;
}

TEST(InfoJson, OrthographicCamerasTellWhatTheyShow) {
    Scene scene = square().scene;
    Camera plan;
    plan.name = "plan";
    plan.half_extent = {4.0, 1.5};
    scene.cameras.push_back(plan);
    const json camera = info_of(scene)["camera_list"][0];
    EXPECT_EQ(camera["kind"], "orthographic");
    EXPECT_EQ(camera["extent"], json({8.0, 3.0}));
    EXPECT_FALSE(camera.contains("field_of_view"));
    const std::string text = rows(info_text(info_of(scene)), "cameras");
    EXPECT_NE(text.find("orthographic, 8 x 3 scene units"), std::string::npos) << text;
}

TEST(InfoJson, TexturedEmissionCountsByItsTexels) {
    test::SceneBuilder builder = square();
    Texture texture;
    texture.width = texture.height = 1;
    texture.srgb = false;
    texture.rgba = {51, 51, 51, 255};
    builder.scene.textures.push_back(texture);
    const std::uint32_t emitter = builder.material(glm::vec3(0.5F), glm::vec3(10.0F));
    builder.scene.materials[emitter].emission.texture = 0;
    builder.add(test::quad_mesh({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), emitter);
    const json info = info_of(builder.scene);
    const json light = info["light_list"][0];
    EXPECT_EQ(light["textured"], true);
    EXPECT_EQ(light["triangles"], 2);
    EXPECT_NEAR(light["power"][0].get<double>(), 3.14159265 * 10.0 * 0.2, 1e-4);
    EXPECT_EQ(info["effects"][0], "area lights");
    EXPECT_EQ(info["effects"][2], "textured emission");
    EXPECT_TRUE(info["indirect"]["vpls_landed"].is_number());
}

TEST(InfoJson, AnImageOfTheEnvironmentHasItsNameSizeAndMean) {
    test::SceneBuilder builder = square();
    builder.scene.environment = Environment{
        glm::vec3(2.0F),
        std::make_shared<const EnvironmentImage>(test::constant_image({1.0F, 0.5F, 0.25F}))};
    const json info = info_of(builder.scene);
    const json& light = info["light_list"].at(0);
    EXPECT_EQ(light["name"], "made up");
    EXPECT_EQ(light["kind"], "environment");
    EXPECT_EQ(light["image"], json({4, 2}));
    EXPECT_NEAR(light["power"][0].get<double>(), 2.0, 1e-9);
    EXPECT_NEAR(light["power"][2].get<double>(), 0.5, 1e-9);
    EXPECT_NE(info["effects"].dump().find("\"image environment\""), std::string::npos);
    const std::string text = rows(info_text(info), "lights");
    EXPECT_NE(text.find("environment, RGB 2 1 0.5 W/(m^2 sr) on average, image of"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("4 x 2 pixels"), std::string::npos) << text;
}

TEST(InfoJson, DefaultLightsAreMarked) {
    Scene scene = square().scene;
    Diagnostics diagnostics;
    add_default_light(scene, DefaultLight::as_needed, diagnostics);
    const json list = info_of(scene)["light_list"];
    ASSERT_EQ(list.size(), 2U);
    for (const json& light : list) EXPECT_EQ(light["default"], true) << light;
    const std::string text = rows(info_text(info_of(scene)), "lights");
    EXPECT_NE(text.find("directional, 1.5 W/m^2, added by Weft"), std::string::npos) << text;
}

TEST(InfoJson, AnimationsCountTheFramesUpToTheirLastKey) {
    test::SceneBuilder builder = square();
    // A last key on frame 60, one between frames, and one that is rounded to a float below
    // frame 29.
    builder.scene.animation.clips = {{"turn", 2.0, 3, 3},
                                     {"jump", 0.71, 4, 1},
                                     {"rest", static_cast<double>(29.0F / 30.0F), 2, 0}};
    const json list = info_of(builder.scene)["animations"];
    EXPECT_EQ(list[0]["frames"], 61);
    EXPECT_EQ(list[1]["frames"], 22);
    EXPECT_EQ(list[2]["frames"], 30);
    EXPECT_EQ(rows(info_text(info_of(builder.scene)), "animations"),
              "animations    turn  2 s, 61 frames at 30 a second\n"
              "              jump  0.71 s, 22 frames at 30 a second, 1 of 4 channels played\n"
              "              rest  0.9667 s, 30 frames at 30 a second, not played\n");
}

TEST(InfoJson, SurfacesTellTheirLobes) {
    test::SceneBuilder builder = square();
    EXPECT_TRUE(info_of(builder.scene)["surfaces"].empty()) << "all are diffuse";
    EXPECT_EQ(rows(info_text(info_of(builder.scene)), "surfaces"), "");
    Texture texture;
    texture.name = "rust";
    texture.width = 2;
    texture.height = 1;
    texture.srgb = false;
    texture.rgba = {0, 0, 0, 255, 0, 255, 0, 255};
    builder.scene.textures.push_back(texture);
    MetallicSurface metal;
    metal.roughness.value = {0.5F, {0, 0, glm::dmat3(1.0), Channel::green}};
    metal.clearcoat.factor.factor = 1.0F;
    Material& material = builder.scene.materials[0];
    material.name = "hood";
    material.description = SurfaceDescription{metal, {}, {}};
    builder.scene.meshes[0].uv_sets.emplace_back(4, glm::vec2(0.0F));
    const json info = info_of(builder.scene);
    ASSERT_EQ(info["surfaces"].size(), 1U);
    const json& surface = info["surfaces"][0];
    EXPECT_EQ(surface["name"], "hood");
    ASSERT_EQ(surface["lobes"].size(), 2U);
    EXPECT_EQ(surface["lobes"][0],
              json({{"name", "metal"}, {"roughness", {"delta", "rough"}}, {"alpha", {0.0, 0.25}}}));
    EXPECT_EQ(surface["lobes"][1]["name"], "clear coat");
    EXPECT_EQ(surface["effects"], json({"mirror reflection", "glossy reflection"}));
    EXPECT_EQ(rows(info_text(info), "surfaces"),
              "surfaces      more than diffuse: 1 of 1 material\n"
              "              hood  metal (delta to rough), clear coat (delta): mirror\n"
              "                    reflection, glossy reflection\n");
}

TEST(InfoJson, ApproximationsAreTheKindsOfWarnings) {
    const Scene scene = square().scene;
    Diagnostics diagnostics;
    WarningCollector report(diagnostics);
    report.count("a.gltf#/materials/1", {"material", "materials"}, "gloss is dull, a bit");
    report.count("a.gltf#/materials/3", {"material", "materials"}, "gloss is dull, a bit");
    report.once("a.gltf", "texts are ignored");
    diagnostics.warn("a.gltf", "no light");
    const json info = info_json(scene, diagnostics);
    ASSERT_EQ(info["approximations"].size(), 2U) << "the default light is no approximation";
    EXPECT_EQ(info["approximations"][0],
              json({{"message", "gloss is dull, a bit"},
                    {"title", "gloss is dull"},
                    {"number", 2},
                    {"unit", "materials"},
                    {"places", {"a.gltf#/materials/1", "a.gltf#/materials/3"}}}));
    EXPECT_EQ(rows(info_text(info), "approximated"),
              "approximated  2 materials: gloss is dull\n"
              "              texts are ignored\n");
    EXPECT_EQ(rows(info_text(info_of(scene)), "approximated"), "approximated  nothing\n");
}

TEST(InfoJson, TextHas80ColumnsAndLongListsEnd) {
    test::SceneBuilder builder = square();
    for (int i = 0; i < 40; ++i)
        builder.light(LightType::point, {0, 0, 2}, {1.0F, 2.0F, 3.0F}).name =
            "a light with a name that is much too long for a table " + std::to_string(i);
    builder.scene.media.emplace_back();
    builder.scene.media.back().name = "a fog whose name fills nearly all of a line";
    builder.scene.lights[3].name = "line\nend";
    Diagnostics diagnostics;
    WarningCollector(diagnostics)
        .count("a", {"material", "materials"},
               "something that takes more words to tell than fit into a line is not simulated");
    const std::string text = info_text(info_json(builder.scene, diagnostics));
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        EXPECT_LE(count_characters(text.substr(begin, end - begin)), 80U)
            << text.substr(begin, end - begin);
        EXPECT_NE(text[end - 1], ' ');
        begin = end + 1;
    }
    const std::string lights = rows(text, "lights");
    EXPECT_NE(lights.find("a light wi...r a table 0  point"), std::string::npos) << lights;
    EXPECT_NE(lights.find("and 28 more, which --json lists\n"), std::string::npos) << lights;
    EXPECT_NE(lights.find("line?end"), std::string::npos) << lights;
}

}  // namespace
}  // namespace weft::info_json_test
