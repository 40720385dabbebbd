// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_surface.h"

#include <gtest/gtest.h>

#include <numbers>
#include <variant>

#include "tests/testing/gltf_builder.h"

namespace weft::gltf_surface_test {
namespace {

using Json = nlohmann::json;

/// 2 x 2 pixels: red, green above blue, white.
constexpr const char* image =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR42mP4z8DwHwyBNAg0AABJSQl4nFEXkgAAAABJ"
    "RU5ErkJggg==";

/// A triangle with two sets of texture coordinates, two textures of one image, and this material.
GltfBuilder builder_with(const Json& material) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.add_floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    builder.add_floats({0.5F, 0.5F, 0.25F, 0.5F, 0.75F, 0.5F}, "VEC2", 2);
    builder.primitive()["attributes"]["TEXCOORD_0"] = 1;
    builder.primitive()["attributes"]["TEXCOORD_1"] = 2;
    builder.primitive()["material"] = 0;
    builder.json["images"] = {{{"uri", image}}, {{"uri", image}}};
    builder.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    builder.json["materials"] = Json::array({material});
    return builder;
}

/// A material with one extension.
Json extended(const char* name, const Json& extension) {
    return {{"extensions", {{name, extension}}}};
}

const SurfaceDescription& described(const Scene& scene) {
    const Material& material = scene.materials.at(scene.instances.at(0).material);
    EXPECT_TRUE(material.description.has_value());
    static const SurfaceDescription none;
    return material.description ? *material.description : none;
}

template <class Model>
Model model_of(GltfBuilder builder) {
    const Scene scene = builder.read();
    const Model* const model = std::get_if<Model>(&described(scene).model);
    EXPECT_NE(model, nullptr);
    return model == nullptr ? Model{} : *model;
}

MetallicSurface metallic(const Json& material) {
    return model_of<MetallicSurface>(builder_with(material));
}

void expect_map(const TextureMap& map, int texture, Channel channel, std::uint32_t set = 0) {
    EXPECT_EQ(map.texture, texture);
    EXPECT_EQ(map.channel, channel);
    EXPECT_EQ(map.uv_set, set);
}

TEST(GltfSurface, DefaultsAreThoseOfTheFormat) {
    const MetallicSurface surface = metallic(Json::object());
    EXPECT_EQ(surface.metallic.factor, 1.0F);
    EXPECT_EQ(surface.roughness.value.factor, 1.0F);
    EXPECT_EQ(surface.roughness.scale, RoughnessScale::roughness);
    EXPECT_EQ(surface.base_colour.factor, glm::vec3(1.0F));
    EXPECT_EQ(surface.ior, 1.5F);
    EXPECT_EQ(surface.specular.factor, 1.0F);
    EXPECT_EQ(surface.specular_colour.factor, glm::vec3(1.0F));
    EXPECT_TRUE(surface.transmission.is_zero());
    EXPECT_FALSE(surface.solid);
    EXPECT_FALSE(surface.clearcoat.present());
    // So is the material of primitives without one.
    GltfBuilder bare = GltfBuilder::triangle();
    EXPECT_EQ(model_of<MetallicSurface>(bare).metallic.factor, 1.0F);
}

TEST(GltfSurface, ReadsMetalAndRoughnessOfOneTexture) {
    GltfBuilder builder = builder_with({{"pbrMetallicRoughness",
                                         {{"baseColorFactor", {0.25, 0.5, 1, 1}},
                                          {"baseColorTexture", {{"index", 0}}},
                                          {"metallicFactor", 0.5},
                                          {"roughnessFactor", 0.75},
                                          {"metallicRoughnessTexture", {{"index", 1}}}}}});
    const Scene scene = builder.read();
    const auto& surface = std::get<MetallicSurface>(described(scene).model);
    EXPECT_EQ(surface.base_colour.factor, glm::vec3(0.25F, 0.5F, 1.0F));
    EXPECT_EQ(surface.metallic.factor, 0.5F);
    EXPECT_EQ(surface.roughness.value.factor, 0.75F);
    expect_map(surface.base_colour.map, 0, Channel::rgb);
    expect_map(surface.metallic.map, 1, Channel::blue);
    expect_map(surface.roughness.value.map, 1, Channel::green);
    ASSERT_EQ(scene.textures.size(), 2U) << "one for each use";
    EXPECT_TRUE(scene.textures[0].srgb);
    EXPECT_FALSE(scene.textures[1].srgb) << "data";
    EXPECT_FALSE(scene.textures[1].has_alpha);
    // What is rendered stays the diffuse surface.
    EXPECT_TRUE(is_lambertian(scene.materials[0]));
    EXPECT_EQ(diffuse_albedo(scene.materials[0]), glm::vec3(0.25F, 0.5F, 1.0F));
}

TEST(GltfSurface, OneImageIsReadTwiceForColourAndData) {
    GltfBuilder builder = builder_with(
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
         {"normalTexture", {{"index", 0}}}});
    const Scene scene = builder.read();
    ASSERT_EQ(scene.textures.size(), 2U);
    EXPECT_TRUE(scene.textures[0].srgb);
    EXPECT_FALSE(scene.textures[1].srgb);
    EXPECT_EQ(described(scene).normal_map.map.texture, 1);
}

TEST(GltfSurface, LambertIsADielectricWithoutReflection) {
    Json material = extended("KHR_materials_specular", {{"specularFactor", 0}});
    material["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
    GltfBuilder builder = builder_with(material);
    EXPECT_FALSE(builder.read().materials.at(0).description.has_value());
    EXPECT_TRUE(builder.diagnostics.warnings().empty()) << "this is what is rendered";
    // Metal takes no notice of it.
    material["pbrMetallicRoughness"]["metallicFactor"] = 0.5;
    EXPECT_EQ(metallic(material).specular.factor, 0.0F);
    // A normal map and gaps are more than a diffuse surface has.
    material["pbrMetallicRoughness"]["metallicFactor"] = 0;
    material["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
    builder = builder_with(material);
    const Scene scene = builder.read();
    EXPECT_TRUE(std::holds_alternative<LambertSurface>(described(scene).model));
    EXPECT_EQ(described(scene).normal_map.scale, 0.5F);
    expect_map(described(scene).normal_map.map, 0, Channel::rgb);
}

TEST(GltfSurface, DiffuseDetailReadsNoMore) {
    GltfBuilder builder = builder_with({{"normalTexture", {{"index", 7}}}});
    const TemporaryFolder folder;
    Diagnostics diagnostics;
    const Scene scene =
        read_gltf(folder.write("a.gltf", builder.text()), diagnostics, MaterialDetail::diffuse);
    EXPECT_FALSE(scene.materials.at(0).description.has_value());
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_EQ(diagnostics.warnings().size(), 2U) << "metal, and the normal map";
}

TEST(GltfSurface, ReadsSpecularAndIndex) {
    Json material = extended("KHR_materials_specular", {{"specularFactor", 0.5},
                                                        {"specularTexture", {{"index", 0}}},
                                                        {"specularColorFactor", {2, 1, 0.5}},
                                                        {"specularColorTexture", {{"index", 0}}}});
    material["extensions"]["KHR_materials_ior"] = {{"ior", 1.33}};
    GltfBuilder builder = builder_with(material);
    const Scene scene = builder.read();
    const auto& surface = std::get<MetallicSurface>(described(scene).model);
    EXPECT_EQ(surface.specular.factor, 0.5F);
    expect_map(surface.specular.map, 0, Channel::alpha);
    EXPECT_EQ(surface.specular_colour.factor, glm::vec3(2.0F, 1.0F, 0.5F)) << "may exceed 1";
    expect_map(surface.specular_colour.map, 0, Channel::rgb);
    EXPECT_EQ(surface.ior, 1.33F);
    ASSERT_EQ(scene.textures.size(), 1U) << "alpha is linear in any texture";
    EXPECT_TRUE(scene.textures[0].has_alpha);
    material["extensions"]["KHR_materials_ior"]["ior"] = 0;
    EXPECT_EQ(metallic(material).ior, 0.0F) << "reflects by its colour alone";
}

TEST(GltfSurface, ReadsTransmissionAndClearcoat) {
    Json material =
        extended("KHR_materials_transmission",
                 {{"transmissionFactor", 0.75}, {"transmissionTexture", {{"index", 1}}}});
    material["extensions"]["KHR_materials_clearcoat"] = {
        {"clearcoatFactor", 0.5},
        {"clearcoatTexture", {{"index", 1}}},
        {"clearcoatRoughnessFactor", 0.25},
        {"clearcoatRoughnessTexture", {{"index", 1}, {"texCoord", 1}}},
        {"clearcoatNormalTexture", {{"index", 1}, {"scale", 2}}}};
    const MetallicSurface surface = metallic(material);
    EXPECT_EQ(surface.transmission.factor, 0.75F);
    expect_map(surface.transmission.map, 0, Channel::red);
    EXPECT_EQ(surface.clearcoat.factor.factor, 0.5F);
    expect_map(surface.clearcoat.factor.map, 0, Channel::red);
    EXPECT_EQ(surface.clearcoat.roughness.value.factor, 0.25F);
    expect_map(surface.clearcoat.roughness.value.map, 0, Channel::green, 1);
    expect_map(surface.clearcoat.normal_map.map, 0, Channel::rgb);
    EXPECT_EQ(surface.clearcoat.normal_map.scale, 2.0F);
}

TEST(GltfSurface, FactorsOfZeroSwitchTheirTexturesOff) {
    Json material = extended("KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", 0}}}});
    material["extensions"]["KHR_materials_transmission"] = {
        {"transmissionTexture", {{"index", 0}}}};
    material["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyTexture", {{"index", 0}}}};
    GltfBuilder builder = builder_with(material);
    EXPECT_TRUE(builder.read().textures.empty());
}

TEST(GltfSurface, ReadsAnisotropy) {
    const MetallicSurface surface =
        metallic(extended("KHR_materials_anisotropy", {{"anisotropyStrength", 0.5},
                                                       {"anisotropyRotation", 1.5},
                                                       {"anisotropyTexture", {{"index", 0}}}}));
    EXPECT_EQ(surface.anisotropy.strength, 0.5F);
    EXPECT_EQ(surface.anisotropy.rotation, 1.5F);
    expect_map(surface.anisotropy.map, 0, Channel::rgb);
}

/// Corners of a tetrahedron that encloses a volume.
GltfBuilder tetrahedron(const Json& material) {
    GltfBuilder builder;
    builder.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
    builder.add_accessor<std::uint16_t>({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, 5123, "SCALAR", 12);
    builder.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}};
    builder.json["nodes"] = {{{"mesh", 0}}};
    builder.json["scenes"] = {{{"nodes", {0}}}};
    builder.json["materials"] = Json::array({material});
    return builder;
}

TEST(GltfSurface, VolumesAreSolidWhereTheyHaveThicknessAndTheMeshIsClosed) {
    Json material = extended("KHR_materials_transmission", {{"transmissionFactor", 1}});
    material["extensions"]["KHR_materials_volume"] = {
        {"thicknessFactor", 0.1}, {"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 0.25}}};
    GltfBuilder builder = tetrahedron(material);
    const MetallicSurface solid = model_of<MetallicSurface>(builder);
    EXPECT_TRUE(solid.solid);
    EXPECT_EQ(solid.absorption.distance, 2.0);
    EXPECT_EQ(solid.absorption.colour, glm::vec3(1.0F, 0.5F, 0.25F));

    // An open mesh is thin; the closed one that shares the material is not.
    builder.add_accessor<std::uint16_t>({0, 2, 1}, 5123, "SCALAR", 3);
    Json open = builder.primitive();
    open["indices"] = 2;
    builder.json["meshes"][0]["primitives"].push_back(open);
    builder.json["meshes"][0]["primitives"].push_back(open);
    const Scene scene = builder.read();
    ASSERT_EQ(scene.instances.size(), 3U);
    const auto is_solid = [&](std::size_t instance) {
        const Material& used = scene.materials.at(scene.instances[instance].material);
        return std::get<MetallicSurface>(used.description->model).solid;
    };
    EXPECT_TRUE(is_solid(0));
    EXPECT_FALSE(is_solid(1));
    EXPECT_EQ(scene.instances[1].material, scene.instances[2].material);
    EXPECT_EQ(scene.materials.size(), 2U);
    EXPECT_TRUE(builder.warned(
        "2 primitives: glass with a volume on a mesh that is not closed, it is taken as thin"));

    // Without thickness, without the volume, and without transmission nothing is solid.
    material["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 0;
    EXPECT_FALSE(model_of<MetallicSurface>(tetrahedron(material)).solid);
    material["extensions"].erase("KHR_materials_volume");
    EXPECT_FALSE(model_of<MetallicSurface>(tetrahedron(material)).solid);
    const Json opaque = extended("KHR_materials_volume", {{"thicknessFactor", 1}});
    EXPECT_FALSE(model_of<MetallicSurface>(tetrahedron(opaque)).solid);
}

TEST(GltfSurface, ReadsSpecularGlossiness) {
    const Json extension = {{"diffuseFactor", {0.5, 0.25, 1, 0.75}},
                            {"diffuseTexture", {{"index", 0}}},
                            {"specularFactor", {0.25, 0.5, 0.75}},
                            {"glossinessFactor", 0.5},
                            {"specularGlossinessTexture", {{"index", 1}}}};
    Json material = extended("KHR_materials_pbrSpecularGlossiness", extension);
    material["alphaMode"] = "BLEND";
    GltfBuilder builder = builder_with(material);
    builder.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
    const Scene scene = builder.read();
    const auto& surface = std::get<SpecularSurface>(described(scene).model);
    EXPECT_EQ(surface.diffuse.factor, glm::vec3(0.5F, 0.25F, 1.0F));
    EXPECT_EQ(surface.specular.factor, glm::vec3(0.25F, 0.5F, 0.75F));
    EXPECT_TRUE(surface.diffuse_is_scaled);
    EXPECT_EQ(surface.roughness.scale, RoughnessScale::glossiness);
    EXPECT_EQ(surface.roughness.value.factor, 0.5F);
    expect_map(surface.roughness.value.map, surface.specular.map.texture, Channel::alpha);
    EXPECT_TRUE(scene.textures.at(static_cast<std::size_t>(surface.specular.map.texture)).srgb);
    EXPECT_EQ(described(scene).opacity.alpha.factor, 0.75F);
    expect_map(described(scene).opacity.alpha.map, surface.diffuse.map.texture, Channel::alpha);
}

TEST(GltfSurface, ReadsUnlit) {
    Json material = extended("KHR_materials_unlit", Json::object());
    material["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 0.5, 0, 1}},
                                        {"metallicRoughnessTexture", {{"index", 0}}}};
    material["normalTexture"] = {{"index", 0}};
    GltfBuilder builder = builder_with(material);
    const Scene scene = builder.read();
    EXPECT_EQ(std::get<UnlitSurface>(described(scene).model).colour.factor,
              glm::vec3(1.0F, 0.5F, 0.0F));
    EXPECT_FALSE(described(scene).normal_map.present());
    EXPECT_TRUE(scene.textures.empty());
}

TEST(GltfSurface, ReadsAlphaOfFactorTextureAndVertices) {
    GltfBuilder builder = builder_with(
        {{"alphaMode", "MASK"},
         {"alphaCutoff", 0.25},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 1, 1, 0.5}}, {"baseColorTexture", {{"index", 0}}}}}});
    builder.add_floats({1, 1, 1, 0.5F, 1, 1, 1, 2, 1, 1, 1, -1}, "VEC4", 4);
    builder.primitive()["attributes"]["COLOR_0"] = 3;
    Scene scene = builder.read();
    const Opacity& opacity = described(scene).opacity;
    EXPECT_EQ(opacity.mode, OpacityMode::mask);
    EXPECT_EQ(opacity.cutoff, 0.25F);
    EXPECT_EQ(opacity.alpha.factor, 0.5F);
    expect_map(opacity.alpha.map, 0, Channel::alpha);
    EXPECT_TRUE(scene.textures.at(0).has_alpha);
    EXPECT_EQ(scene.meshes.at(0).alphas, (std::vector<float>{0.5F, 1.0F, 0.0F}));
    // An opaque surface has no use for alpha.
    builder.json["materials"][0]["alphaMode"] = "OPAQUE";
    scene = builder.read();
    EXPECT_EQ(described(scene).opacity.mode, OpacityMode::opaque);
    EXPECT_FALSE(scene.textures.at(0).has_alpha);
    EXPECT_TRUE(scene.meshes.at(0).alphas.empty());
    builder.json["materials"][0]["alphaMode"] = "BLEND";
    EXPECT_EQ(described(builder.read()).opacity.mode, OpacityMode::blend);
}

TEST(GltfSurface, EachTextureHasCoordinatesAndATransformOfItsOwn) {
    GltfBuilder builder = builder_with(
        {{"pbrMetallicRoughness",
          {{"metallicRoughnessTexture",
            {{"index", 0},
             {"texCoord", 1},
             {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}}}}}}}}},
         {"normalTexture",
          {{"index", 0},
           {"extensions",
            {{"KHR_texture_transform",
              {{"rotation", std::numbers::pi / 2}, {"scale", {2, 4}}, {"texCoord", 0}}}}}}}});
    const Scene scene = builder.read();
    const auto& surface = std::get<MetallicSurface>(described(scene).model);
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.uv_sets.size(), 2U);
    EXPECT_EQ(mesh.uv_sets[0][2], glm::vec2(0.75F, 0.5F)) << "the first that is asked for";
    EXPECT_EQ(mesh.uv_sets[1][2], glm::vec2(0.0F, 1.0F));
    EXPECT_TRUE(mesh.uvs.empty()) << "no base colour texture";
    EXPECT_EQ(surface.metallic.map.uv_set, 0U);
    EXPECT_EQ(surface.metallic.map.to_uv[2], glm::dvec3(0.5, 0.25, 1.0));
    const TextureMap& normal = described(scene).normal_map.map;
    EXPECT_EQ(normal.uv_set, 1U);
    // The example of the extension: rotation turns (1, 0) of the scaled coordinates to (0, -1).
    const glm::dvec3 turned = normal.to_uv * glm::dvec3(1, 0, 1);
    EXPECT_NEAR(turned.x, 0.0, 1e-12);
    EXPECT_NEAR(turned.y, -2.0, 1e-12);
}

TEST(GltfSurface, MissingCoordinatesAreToldOnce) {
    GltfBuilder builder =
        builder_with({{"pbrMetallicRoughness",
                       {{"baseColorTexture", {{"index", 0}, {"texCoord", 5}}},
                        {"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 5}}}}}});
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes.at(0).uv_sets.at(0), std::vector<glm::vec2>(3, glm::vec2(0.0F)));
    EXPECT_TRUE(builder.warned("1 primitive: texture coordinates are missing"));
}

TEST(GltfSurface, FourSetsOfCoordinatesAreEnough) {
    Json coat = {{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 1}};
    int set = 2;
    for (const char* key :
         {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"})
        coat[key] = {{"index", 0}, {"texCoord", set++}};
    Json material = extended("KHR_materials_clearcoat", coat);
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}, {"texCoord", 1}};
    material["normalTexture"] = {{"index", 0}, {"texCoord", 9007199254740992}};
    GltfBuilder builder = builder_with(material);
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes.at(0).uv_sets.size(), 4U);
    EXPECT_FALSE(described(scene).normal_map.present());
    EXPECT_TRUE(builder.warned("1 texture: more than 4 sets of texture coordinates in a material"));
}

TEST(GltfSurface, ClampsWhatIsOutOfRange) {
    Json material = extended("KHR_materials_transmission", {{"transmissionFactor", 2}});
    material["pbrMetallicRoughness"] = {{"metallicFactor", -1}, {"roughnessFactor", 1e300}};
    material["extensions"]["KHR_materials_ior"] = {{"ior", 1e30}};
    material["extensions"]["KHR_materials_specular"] = {{"specularFactor", -3},
                                                        {"specularColorFactor", {-1, 1e300, 2}}};
    material["extensions"]["KHR_materials_volume"] = {
        {"thicknessFactor", -1}, {"attenuationDistance", 0}, {"attenuationColor", {2, -1, 0.5}}};
    material["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 7},
                                                         {"clearcoatRoughnessFactor", -7}};
    material["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 9},
                                                          {"anisotropyRotation", -1e300}};
    material["alphaMode"] = "MASK";
    material["alphaCutoff"] = -1;
    material["normalTexture"] = {{"index", 0}, {"scale", 1e300}};
    GltfBuilder builder = builder_with(material);
    const Scene scene = builder.read();
    const auto& surface = std::get<MetallicSurface>(described(scene).model);
    EXPECT_EQ(surface.transmission.factor, 1.0F);
    EXPECT_EQ(surface.metallic.factor, 0.0F);
    EXPECT_EQ(surface.roughness.value.factor, 1.0F);
    EXPECT_EQ(surface.ior, 100.0F);
    EXPECT_EQ(surface.specular.factor, 0.0F);
    EXPECT_EQ(surface.specular_colour.factor.r, 0.0F);
    EXPECT_TRUE(std::isfinite(surface.specular_colour.factor.g));
    EXPECT_FALSE(surface.solid);
    EXPECT_EQ(sigma_a(surface.absorption), glm::dvec3(0.0));
    EXPECT_EQ(surface.absorption.colour, glm::vec3(1.0F, 0.0F, 0.5F));
    EXPECT_EQ(surface.clearcoat.factor.factor, 1.0F);
    EXPECT_EQ(surface.clearcoat.roughness.value.factor, 0.0F);
    EXPECT_EQ(surface.anisotropy.strength, 1.0F);
    EXPECT_TRUE(std::isfinite(surface.anisotropy.rotation));
    EXPECT_EQ(described(scene).opacity.cutoff, 0.0F);
    EXPECT_EQ(described(scene).normal_map.scale, 1000.0F);
    for (const char* name : {"metallicFactor", "roughnessFactor", "transmissionFactor", "ior",
                             "specularFactor", "specularColorFactor", "thicknessFactor",
                             "attenuationColor", "clearcoatFactor", "clearcoatRoughnessFactor",
                             "anisotropyStrength", "anisotropyRotation", "alphaCutoff", "scale"})
        EXPECT_TRUE(builder.warned(std::string(name) + " lies outside of its range and is clamped"))
            << name;
    EXPECT_TRUE(builder.warned("attenuationDistance is not above 0, nothing is absorbed"));
    // An index below 1 is no index of a material in air.
    EXPECT_EQ(metallic(extended("KHR_materials_ior", {{"ior", 0.5}})).ior, 1.0F);
}

TEST(GltfSurface, TransformsThatOverflowAreLeftOut) {
    GltfBuilder builder = builder_with(
        {{"normalTexture",
          {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {1e300, 1}}}}}}}}});
    EXPECT_EQ(described(builder.read()).normal_map.map.to_uv, glm::dmat3(1.0));
    EXPECT_TRUE(builder.warned("the texture transform is too large, left out"));
}

TEST(GltfSurface, RefusesWhatIsBrokenWithItsPlace) {
    const auto error_of = [](const Json& material) { return builder_with(material).error(); };
    EXPECT_EQ(error_of({{"normalTexture", {{"index", 2}}}}),
              "#/materials/0/normalTexture/index: is 2, but there are only 2 textures");
    EXPECT_EQ(error_of({{"normalTexture", Json::object()}}),
              "#/materials/0/normalTexture: lacks 'index', which is required");
    EXPECT_EQ(error_of({{"normalTexture", {{"index", 0}, {"texCoord", -1}}}}),
              "#/materials/0/normalTexture/texCoord: is -1, expected a whole number that is not "
              "negative");
    EXPECT_EQ(error_of({{"pbrMetallicRoughness", {{"metallicFactor", "steel"}}}}),
              "#/materials/0/pbrMetallicRoughness/metallicFactor: is of type string, expected a "
              "number");
    EXPECT_EQ(error_of(extended("KHR_materials_clearcoat",
                                {{"clearcoatFactor", 1}, {"clearcoatTexture", {{"index", 9}}}})),
              "#/materials/0/extensions/KHR_materials_clearcoat/clearcoatTexture/index: is 9, but "
              "there are only 2 textures");
    EXPECT_EQ(error_of(extended("KHR_materials_specular", {{"specularColorFactor", {1, 1}}})),
              "#/materials/0/extensions/KHR_materials_specular/specularColorFactor: has 2 "
              "elements, expected 3");
    EXPECT_EQ(error_of(extended("KHR_materials_pbrSpecularGlossiness",
                                {{"glossinessFactor", Json::array()}})),
              "#/materials/0/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor: is "
              "of type array, expected a number");
    EXPECT_EQ(error_of(extended("KHR_materials_ior", 3)),
              "#/materials/0/extensions/KHR_materials_ior: is of type number, expected an object");
}

TEST(GltfSurface, ExtensionsWithASubstituteAreNotRefused) {
    GltfBuilder builder = builder_with(Json::object());
    builder.json["extensionsRequired"] = builder.json["extensionsUsed"] = {
        "KHR_materials_volume_scatter", "KHR_materials_variants", "KHR_materials_sheen"};
    builder.read();
    EXPECT_TRUE(
        builder.warned("extension 'KHR_materials_volume_scatter' is not supported and is ignored"));
    EXPECT_FALSE(builder.warned("KHR_materials_variants")) << "the default variant is rendered";
}

}  // namespace
}  // namespace weft::gltf_surface_test
