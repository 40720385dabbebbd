// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_materials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/testing/gltf_builder.h"

namespace weft::gltf_materials_test {
namespace {

using Json = nlohmann::json;

/// 2 x 2 pixels: red, green above blue, white.
constexpr const char* image =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR42mP4z8DwHwyBNAg0AABJSQl4nFEXkgAAAABJ"
    "RU5ErkJggg==";

/// A triangle with texture coordinates and a material that the test fills in.
GltfBuilder textured_triangle() {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.add_floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    builder.add_floats({0.5F, 0.5F, 0.25F, 0.5F, 0.75F, 0.5F}, "VEC2", 2);
    builder.primitive()["attributes"]["TEXCOORD_0"] = 1;
    builder.primitive()["attributes"]["TEXCOORD_1"] = 2;
    builder.primitive()["material"] = 0;
    builder.json["images"] = {{{"uri", image}, {"name", "tiles"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}}};
    return builder;
}

Json& pbr(GltfBuilder& builder) {
    return builder.json["materials"][0]["pbrMetallicRoughness"];
}

TEST(GltfMaterials, ReadsFactorsAndFlags) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.primitive()["material"] = 0;
    builder.json["materials"] = {
        {{"name", "paint"},
         {"doubleSided", true},
         {"pbrMetallicRoughness", {{"baseColorFactor", {0.25, 0.5, 1, 1}}, {"metallicFactor", 0}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 10}}}}}}};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].name, "paint");
    EXPECT_EQ(diffuse_albedo(scene.materials[0]), glm::vec3(0.25F, 0.5F, 1.0F));
    EXPECT_EQ(scene.materials[0].emission.radiance, glm::vec3(10, 5, 0));
    EXPECT_TRUE(scene.materials[0].emission.both_sides);
    EXPECT_TRUE(scene.materials[0].two_sided);
    EXPECT_EQ(albedo_texture(scene.materials[0]), -1);
    EXPECT_TRUE(builder.diagnostics.warnings().empty());
}

TEST(GltfMaterials, ReadsTheBaseColourTextureAndItsSampler) {
    GltfBuilder builder = textured_triangle();
    builder.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    builder.json["textures"][0]["sampler"] = 0;
    const Scene scene = builder.read();
    ASSERT_EQ(scene.textures.size(), 1U);
    const Texture& texture = scene.textures[0];
    EXPECT_EQ(texture.name, "tiles");
    EXPECT_EQ(texture.width, 2U);
    EXPECT_TRUE(texture.srgb);
    EXPECT_EQ(texture.wrap_u, Wrap::clamp);
    EXPECT_EQ(texture.wrap_v, Wrap::mirror);
    EXPECT_TRUE(texture.nearest);
    EXPECT_EQ(albedo_texture(scene.materials.at(0)), 0);
    EXPECT_EQ(scene.meshes.at(0).uvs[1], glm::vec2(1, 0));
}

TEST(GltfMaterials, StoresAnImageOnceForEachWayOfSampling) {
    GltfBuilder builder = textured_triangle();
    builder.json["samplers"] = {{{"wrapS", 33071}}};
    builder.json["textures"] = {{{"source", 0}}, {{"source", 0}}, {{"source", 0}, {"sampler", 0}}};
    const Json primitive = builder.primitive();
    for (int i = 1; i < 3; ++i) {
        builder.json["materials"].push_back(builder.json["materials"][0]);
        builder.json["materials"][i]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
        builder.json["meshes"][0]["primitives"].push_back(primitive);
        builder.json["meshes"][0]["primitives"][i]["material"] = i;
    }
    const Scene scene = builder.read();
    EXPECT_EQ(scene.textures.size(), 2U);
    EXPECT_EQ(albedo_texture(scene.materials.at(1)), 0);
    EXPECT_EQ(albedo_texture(scene.materials.at(2)), 1);
}

TEST(GltfMaterials, ReadsImagesFromBufferViews) {
    GltfBuilder builder = textured_triangle();
    const std::string tga = std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0", 18) + "abc";
    builder.json["images"] = {
        {{"bufferView", builder.add_view(std::vector<char>(tga.begin(), tga.end()))},
         {"mimeType", "image/png"}}};
    EXPECT_EQ(builder.read().textures.at(0).rgba, (std::vector<std::uint8_t>{'c', 'b', 'a', 255}));
}

TEST(GltfMaterials, UsesTheSetOfCoordinatesThatTheTextureNames) {
    GltfBuilder builder = textured_triangle();
    pbr(builder)["baseColorTexture"]["texCoord"] = 1;
    EXPECT_EQ(builder.read().meshes.at(0).uvs[2], glm::vec2(0.75F, 0.5F));
    pbr(builder)["baseColorTexture"]["texCoord"] = 2;
    EXPECT_EQ(builder.read().meshes.at(0).uvs, std::vector<glm::vec2>(3, glm::vec2(0.0F)));
    EXPECT_TRUE(builder.warned(
        "1 primitive: texture coordinates are missing, the first texel is used everywhere; at "));
}

TEST(GltfMaterials, AppliesTextureTransforms) {
    GltfBuilder builder = textured_triangle();
    // The lower left quadrant of the image, turned: the example of the extension's document.
    pbr(builder)["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
    builder.json["extensionsRequired"] = {"KHR_texture_transform"};
    const Scene scene = builder.read();
    const std::vector<glm::vec2>& uvs = scene.meshes.at(0).uvs;
    const std::vector<glm::vec2> expected = {{0, 1}, {0, 0.5}, {0.5, 1}};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::length(uvs[i] - expected[i]), 1e-6F) << i;
    pbr(builder)["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}};
    EXPECT_EQ(builder.read().meshes.at(0).uvs[2], glm::vec2(0.75F, 0.5F));
}

TEST(GltfMaterials, ReadsEmissiveTextures) {
    GltfBuilder builder = textured_triangle();
    builder.json["materials"][0]["emissiveFactor"] = {1, 1, 0.5};
    builder.json["materials"][0]["emissiveTexture"]["index"] = 0;
    const auto expect_emission = [&](const Scene& scene) {
        EXPECT_EQ(scene.materials.at(0).emission.radiance, glm::vec3(1.0F, 1.0F, 0.5F));
        EXPECT_EQ(scene.materials.at(0).emission.texture, 0);
        EXPECT_EQ(scene.textures.size(), 1U) << "one image serves both";
        EXPECT_TRUE(builder.diagnostics.warnings().empty());
    };
    Scene scene = builder.read();
    expect_emission(scene);
    EXPECT_TRUE(scene.meshes.at(0).emission_uvs.empty()) << "those of the base colour";
    EXPECT_EQ(scene.meshes.at(0).uvs[1], glm::vec2(1.0F, 0.0F));
    // Each texture by coordinates of its own.
    builder.json["materials"][0]["emissiveTexture"]["texCoord"] = 1;
    scene = builder.read();
    expect_emission(scene);
    EXPECT_EQ(scene.meshes.at(0).uvs[1], glm::vec2(1.0F, 0.0F));
    EXPECT_EQ(scene.meshes.at(0).emission_uvs[2], glm::vec2(0.75F, 0.5F));
    builder.json["materials"][0]["emissiveTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.25, 0}}};
    EXPECT_EQ(builder.read().meshes.at(0).emission_uvs[2], glm::vec2(1.0F, 0.5F));
    // Without a texture of the base colour.
    pbr(builder).erase("baseColorTexture");
    scene = builder.read();
    expect_emission(scene);
    EXPECT_TRUE(scene.meshes.at(0).uvs.empty());
    EXPECT_EQ(scene.meshes.at(0).emission_uvs[2], glm::vec2(1.0F, 0.5F));
    // A factor of 0 switches the texture off.
    builder.json["materials"][0].erase("emissiveFactor");
    scene = builder.read();
    EXPECT_EQ(scene.materials.at(0).emission.texture, -1);
    EXPECT_TRUE(scene.textures.empty());
}

TEST(GltfMaterials, ReadsAndClampsVertexColours) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.add_floats({0.5F, 0.25F, 1, 2, 0, 0, 0, -1, std::numeric_limits<float>::quiet_NaN()},
                       "VEC3", 3);
    builder.primitive()["attributes"]["COLOR_0"] = 1;
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes.at(0).colours[0], glm::vec3(0.5F, 0.25F, 1));
    EXPECT_EQ(scene.meshes.at(0).colours[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.meshes.at(0).colours[2], glm::vec3(0, 0, 0));
    EXPECT_TRUE(builder.warned("2 vertex colours: outside of [0, 1], clamped; at "));
}

TEST(GltfMaterials, ClampsColoursWithAWarning) {
    GltfBuilder builder = textured_triangle();
    pbr(builder)["baseColorFactor"] = {2, -1, 0.5, 1};
    EXPECT_EQ(diffuse_albedo(builder.read().materials.at(0)), glm::vec3(1, 0, 0.5F));
    EXPECT_TRUE(builder.warned_at("pbrMetallicRoughness",
                                  "baseColorFactor lies outside [0, 1] and is clamped"));
}

TEST(GltfMaterials, NamesEachUnsimulatedPropertyOnce) {
    GltfBuilder builder = textured_triangle();
    Json& material = builder.json["materials"][0];
    material["alphaMode"] = "BLEND";
    material["normalTexture"] = {{"index", 0}};
    material["occlusionTexture"] = {{"index", 0}};
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    material["extensions"]["KHR_materials_transmission"] = Json::object();
    material["extensions"]["KHR_materials_clearcoat"] = Json::object();
    pbr(builder)["metallicFactor"] = 1;
    pbr(builder)["roughnessFactor"] = 0.5;
    builder.json["materials"].push_back(material);
    builder.json["meshes"][0]["primitives"].push_back(builder.primitive());
    builder.json["meshes"][0]["primitives"][1]["material"] = 1;
    builder.read(MaterialDetail::diffuse);
    for (const char* text : {"alphaMode BLEND is not simulated", "normal maps are not simulated",
                             "unlit material is not simulated", "transmission is not simulated",
                             "clear coat is not simulated", "metallic reflection is not simulated",
                             "roughness below 1 is not"})
        EXPECT_TRUE(builder.warned(text)) << text;
    EXPECT_EQ(builder.diagnostics.warnings().size(), 7U) << "occlusion needs no texture";
    builder.diagnostics = {};
    builder.read();
    EXPECT_TRUE(builder.diagnostics.warnings().empty()) << "all is described";
}

TEST(GltfMaterials, NamesWhatNoAlgorithmRenders) {
    GltfBuilder builder = textured_triangle();
    Json& material = builder.json["materials"][0];
    for (const char* name : {"KHR_materials_sheen", "KHR_materials_iridescence",
                             "KHR_materials_dispersion", "KHR_materials_diffuse_transmission"})
        material["extensions"][name] = Json::object();
    builder.read();
    for (const char* text :
         {"sheen is not", "iridescence is not", "dispersion is not", "diffuse transmission is not"})
        EXPECT_TRUE(builder.warned(text)) << text;
    EXPECT_EQ(builder.diagnostics.warnings().size(), 4U);
}

TEST(GltfMaterials, RefusesBrokenTexturesWithTheirPlace) {
    const auto error_after = [](const char* pointer, const Json& value) {
        GltfBuilder builder = textured_triangle();
        builder.json["samplers"] = Json::array({Json::object()});
        builder.json["textures"][0]["sampler"] = 0;
        builder.json[Json::json_pointer(pointer)] = value;
        return builder.error();
    };
    EXPECT_EQ(error_after("/materials/0/pbrMetallicRoughness/baseColorTexture/index", 1),
              "#/materials/0/pbrMetallicRoughness/baseColorTexture/index: is 1, but there are only "
              "1 textures");
    EXPECT_EQ(error_after("/textures/0/source", 7),
              "#/textures/0/source: is 7, but there are only 1 images");
    EXPECT_EQ(error_after("/textures/0/sampler", 1),
              "#/textures/0/sampler: is 1, but there are only 1 samplers");
    EXPECT_EQ(error_after("/samplers/0/wrapS", 5),
              "#/samplers/0/wrapS: is 5, expected 10497, 33071 or 33648");
    EXPECT_EQ(error_after("/images/0", Json::object()),
              "#/images/0: lacks both 'uri' and 'bufferView', expected one of them");
    EXPECT_EQ(error_after("/images/0/uri", "data:image/png;base64,AAAA"),
              "#/images/0/uri: image cannot be decoded, expected a PNG, JPEG, BMP or TGA "
              "image");
    EXPECT_EQ(error_after("/materials/0/alphaMode", "GLASS"),
              "#/materials/0/alphaMode: is 'GLASS', expected OPAQUE, MASK or BLEND");
    EXPECT_EQ(error_after("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 2}),
              "#/materials/0/pbrMetallicRoughness/baseColorFactor: has 2 elements, expected 4");
    EXPECT_EQ(error_after("/images/0/uri", "../secret.png").substr(0, 48),
              "#/images/0/uri: reference '../secret.png' leaves");
}

TEST(GltfMaterials, RendersTexturesWithoutAnImageWhite) {
    GltfBuilder builder = textured_triangle();
    builder.json["textures"][0].erase("source");
    EXPECT_EQ(albedo_texture(builder.read().materials.at(0)), -1);
    EXPECT_TRUE(builder.warned_at(
        "#/textures/0", "no PNG or JPEG image is given, plain white is rendered instead"));
}

}  // namespace
}  // namespace weft::gltf_materials_test
