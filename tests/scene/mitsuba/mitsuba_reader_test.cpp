// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/testing/mitsuba_folder.h"

namespace weft::mitsuba_reader_test {
namespace {

using Strings = std::vector<std::string>;

std::string rectangle(const std::string& content) {
    return "<shape type=\"rectangle\">" + content + "</shape>";
}

std::string grey(const std::string& value) {
    return "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" + value + "\"/></bsdf>";
}

void expect_near(const glm::dvec3& value, const glm::dvec3& expected, double tolerance = 1e-6) {
    EXPECT_LT(glm::length(value - expected), tolerance)
        << value.x << " " << value.y << " " << value.z;
}

const Material& only_material(const Scene& scene) {
    EXPECT_EQ(scene.materials.size(), 1U);
    return scene.materials.at(scene.instances.at(0).material);
}

TEST(MitsubaReader, ReadsAnEmptyScene) {
    MitsubaFolder folder;
    const Scene scene = folder.read("");
    EXPECT_EQ(scene.source, (folder.folder().path() / "s.xml").string());
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(scene.cameras.empty());
    EXPECT_FALSE(scene.film.has_value());
    EXPECT_TRUE(folder.warnings().empty());
}

TEST(MitsubaReader, SubstitutesParametersEverywhere) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        "<default name=\"w\" value=\"3\"/><default name=\"w\" value=\"9\"/>"
        "<default name=\"kind\" value=\"persp\"/><default name=\"end\" value=\"ective\"/>"
        "<default name=\"size\" value=\"$w$w\"/>"
        "<sensor type=\"$kind$end\"><film type=\"hdrfilm\">"
        "<integer name=\"width\" value=\"$size\"/><integer name=\"height\" value=\"1$w\"/>"
        "</film></sensor>"
        // The name ends where letters, digits and underscores end.
        "<bsdf type=\"diffuse\" id=\"a.$w-b\"/>" +
        rectangle("<ref id=\"a.3-b\"/>"));
    EXPECT_EQ(scene.film->width, 33U);
    EXPECT_EQ(scene.film->height, 13U);
    EXPECT_EQ(scene.materials.at(0).name, "a.3-b");
}

TEST(MitsubaReader, AppliesTransformsInOrder) {
    MitsubaFolder folder;
    const auto corner = [&](const std::string& transform) {
        const Scene scene =
            folder.read(rectangle("<transform name=\"to_world\">" + transform + "</transform>"));
        return glm::dvec3(scene.instances.at(0).to_world * glm::dvec4(1, 1, 0, 1));
    };
    expect_near(corner(""), {1, 1, 0});
    expect_near(corner("<scale value=\"2\"/>"), {2, 2, 0});
    expect_near(corner("<scale x=\"2\"/>"), {2, 1, 0});
    expect_near(corner("<scale value=\"2 3,4\"/>"), {2, 3, 0});
    expect_near(corner("<translate x=\"1\"/><scale x=\"2\"/>"), {4, 1, 0});
    expect_near(corner("<scale x=\"2\"/><translate x=\"1\"/>"), {3, 1, 0});
    expect_near(corner("<translate value=\"1,2,3\"/>"), {2, 3, 3});
    expect_near(corner("<rotate z=\"1\" angle=\"90\"/>"), {-1, 1, 0});
    expect_near(corner("<rotate value=\"0,0,2\" angle=\"-90\"/>"), {1, -1, 0});
    expect_near(corner("<matrix value=\"1 0 0 5  0 2 0 6  0 0 1 7  0 0 0 1\"/>"), {6, 8, 7});
    expect_near(corner("<matrix value=\"0,1,0, 0,0,1, 1,0,0\"/>"), {1, 0, 1});
    // The same steps as Mitsuba's bounding box of this shape shows.
    expect_near(corner("<scale x=\"2\"/><rotate x=\"1\" angle=\"90\"/>"
                       "<translate x=\"1\" y=\"2\" z=\"3\"/>"),
                {3, 2, 4});
}

TEST(MitsubaReader, KeepsDoublePrecisionInTransforms) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        rectangle("<transform name=\"to_world\"><translate x=\"100000.0000001\"/></transform>"));
    EXPECT_EQ(scene.instances.at(0).to_world[3][0], 100000.0000001);
}

TEST(MitsubaReader, ReadsDiffuseColours) {
    MitsubaFolder folder;
    const auto albedo = [&](const std::string& colour) {
        return diffuse_albedo(
            only_material(folder.read(rectangle("<bsdf type=\"diffuse\">" + colour + "</bsdf>"))));
    };
    EXPECT_EQ(albedo(""), glm::vec3(0.5F));
    EXPECT_EQ(albedo("<rgb name=\"reflectance\" value=\"0.2, 0.4 0.6\"/>"),
              glm::vec3(0.2F, 0.4F, 0.6F));
    EXPECT_EQ(albedo("<rgb name=\"reflectance\" value=\"0.3\"/>"), glm::vec3(0.3F));
    EXPECT_EQ(albedo("<float name=\"reflectance\" value=\"0.25\"/>"), glm::vec3(0.25F));
    EXPECT_EQ(albedo("<spectrum name=\"reflectance\" value=\"0.25\"/>"), glm::vec3(0.25F));
    EXPECT_TRUE(folder.warnings().empty());
    EXPECT_EQ(albedo("<spectrum name=\"reflectance\" value=\"400:0.1, 700:0.3\"/>"),
              glm::vec3(0.2F));
    EXPECT_EQ(folder.warnings(), Strings{"1 spectrum: variation with wavelength is not simulated, "
                                         "the mean is used; at s.xml:2"});
}

TEST(MitsubaReader, OnlyTwosidedSurfacesReflectOnTheirBack) {
    MitsubaFolder folder;
    // Mitsuba's default surface is black from behind, too.
    EXPECT_FALSE(only_material(folder.read(rectangle(""))).two_sided);
    EXPECT_EQ(diffuse_albedo(only_material(folder.read(rectangle("")))), glm::vec3(0.5F));
    EXPECT_FALSE(only_material(folder.read(rectangle(grey("0.1")))).two_sided);
    const Scene scene =
        folder.read(rectangle("<bsdf type=\"twosided\">" + grey("0.1") + "</bsdf>"));
    EXPECT_TRUE(only_material(scene).two_sided);
    EXPECT_EQ(diffuse_albedo(only_material(scene)), glm::vec3(0.1F));
    EXPECT_FALSE(only_material(scene).emission.both_sides);
    EXPECT_TRUE(folder.warnings().empty());
}

TEST(MitsubaReader, FollowsReferencesForwardsBackwardsAndThroughAliases) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        "<bsdf type=\"diffuse\" id=\"early\"><ref name=\"reflectance\" id=\"tex\"/></bsdf>" +
        rectangle("<ref id=\"early\"/>") + rectangle("<ref id=\"late\"/>") +
        rectangle("<ref id=\"other\"/>") +
        "<bsdf type=\"twosided\" id=\"late\"><ref id=\"inner\"/></bsdf>"
        "<bsdf type=\"diffuse\" id=\"inner\"><rgb name=\"reflectance\" value=\"0.1\"/></bsdf>"
        "<texture type=\"bitmap\" id=\"tex\"><string name=\"filename\" value=\"image.tga\"/>"
        "</texture><alias id=\"late\" as=\"other\"/>");
    ASSERT_EQ(scene.instances.size(), 3U);
    ASSERT_EQ(scene.materials.size(), 2U);
    EXPECT_EQ(albedo_texture(scene.materials[scene.instances[0].material]), 0);
    EXPECT_EQ(diffuse_albedo(scene.materials[scene.instances[1].material]), glm::vec3(0.1F));
    EXPECT_EQ(scene.instances[1].material, scene.instances[2].material);
    EXPECT_EQ(scene.materials[scene.instances[1].material].name, "late");
    EXPECT_TRUE(folder.warnings().empty());
}

TEST(MitsubaReader, MakesOneMaterialForEachPairOfSurfaceAndEmitter) {
    MitsubaFolder folder;
    const std::string emitter =
        "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1,2,3\"/></emitter>";
    const Scene scene =
        folder.read("<bsdf type=\"diffuse\" id=\"b\"/>" + rectangle("<ref id=\"b\"/>") +
                    rectangle("<ref id=\"b\"/>") + rectangle("<ref id=\"b\"/>" + emitter));
    ASSERT_EQ(scene.materials.size(), 2U);
    EXPECT_EQ(scene.instances[0].material, scene.instances[1].material);
    EXPECT_EQ(scene.materials[scene.instances[0].material].emission.radiance, glm::vec3(0.0F));
    EXPECT_EQ(scene.materials[scene.instances[2].material].emission.radiance, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.meshes.size(), 1U) << "equal shapes share a mesh";
}

TEST(MitsubaReader, ReadsTexturesWithTheirSettings) {
    MitsubaFolder folder;
    const Scene scene = folder.read(rectangle(
        "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\">"
        "<string name=\"filename\" value=\"image.tga\"/>"
        "<string name=\"filter_type\" value=\"nearest\"/>"
        "<string name=\"wrap_mode\" value=\"mirror\"/><boolean name=\"raw\" value=\"true\"/>"
        "</texture></bsdf>"));
    ASSERT_EQ(scene.textures.size(), 1U);
    const Texture& texture = scene.textures[0];
    EXPECT_EQ(texture.name, "image.tga");
    EXPECT_TRUE(texture.nearest);
    EXPECT_FALSE(texture.srgb);
    EXPECT_EQ(texture.wrap_u, Wrap::mirror);
    EXPECT_EQ(texture.wrap_v, Wrap::mirror);
    EXPECT_EQ(diffuse_albedo(only_material(scene)), glm::vec3(1.0F));
    // In Mitsuba (u,v) = (0.25, 0.25) shows the red pixel of the top row, and on a rectangle that
    // is the corner at (-1,-1); v = 0 is the top of the image for Weft as well.
    ASSERT_GE(texture.rgba.size(), 4U);
    EXPECT_EQ(texture.rgba[0], 255);
    EXPECT_EQ(texture.rgba[1], 0);
    EXPECT_EQ(scene.meshes.at(0).positions.at(0), glm::vec3(-1, -1, 0));
    EXPECT_EQ(scene.meshes.at(0).uvs.at(0), glm::vec2(0, 0));
}

TEST(MitsubaReader, KeepsTheTextureCoordinatesOfPlyFiles) {
    MitsubaFolder folder;
    const Scene scene =
        folder.read("<shape type=\"ply\"><string name=\"filename\" value=\"square.ply\"/></shape>");
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positions.at(3), glm::vec3(-1, 1, 0));
    EXPECT_EQ(mesh.uvs.at(3), glm::vec2(0, 1));
}

/// The coordinates that `to_uv` makes of (0.25, 0.25).
glm::vec2 transformed_uv(const std::string& transform) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        rectangle("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\">"
                  "<string name=\"filename\" value=\"image.tga\"/><transform name=\"to_uv\">" +
                  transform + "</transform></texture></bsdf>"));
    const std::vector<glm::vec2>& uvs = scene.meshes.at(0).uvs;
    return uvs.at(0) + 0.25F * (uvs.at(1) - uvs.at(0)) + 0.25F * (uvs.at(3) - uvs.at(0));
}

// Which texel Mitsuba 3.9 shows at (0.25, 0.25) tells where these coordinates lie.
TEST(MitsubaReader, AppliesTextureTransforms) {
    EXPECT_EQ(transformed_uv("<translate x=\"0.5\"/>"), glm::vec2(0.75F, 0.25F));
    EXPECT_EQ(transformed_uv("<translate y=\"0.25\"/>"), glm::vec2(0.25F, 0.5F));
    EXPECT_EQ(transformed_uv("<scale x=\"2\"/><translate x=\"0.25\"/>"), glm::vec2(0.75F, 0.25F));
    const glm::vec2 turned = transformed_uv("<rotate z=\"1\" angle=\"90\"/>");
    EXPECT_NEAR(turned.x, -0.25F, 1e-6F);
    EXPECT_NEAR(turned.y, 0.25F, 1e-6F);
    EXPECT_EQ(transformed_uv("<matrix value=\"1 0 0 0.5 0 1 0 0 0 0 1 0 0 0 0 1\"/>"),
              glm::vec2(0.75F, 0.25F));
    // The translation of a 3x3 matrix is not used by Mitsuba.
    EXPECT_EQ(transformed_uv("<matrix value=\"1 0 0.5 0 1 0 0 0 1\"/>"), glm::vec2(0.25F, 0.25F));
}

TEST(MitsubaReader, TextureTransformsDoNotLeakIntoOtherShapes) {
    MitsubaFolder folder;
    const std::string textured =
        "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\">"
        "<string name=\"filename\" value=\"image.tga\"/>";
    const std::string end = "</texture></bsdf>";
    const Scene scene = folder.read(
        rectangle(textured + end) +
        rectangle(textured + "<transform name=\"to_uv\"><scale value=\"4\"/></transform>" + end) +
        rectangle(textured + end));
    EXPECT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.meshes.at(scene.instances.at(0).mesh).uvs.at(2), glm::vec2(1, 1));
    EXPECT_EQ(scene.meshes.at(scene.instances.at(1).mesh).uvs.at(2), glm::vec2(4, 4));
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh);
}

// Mitsuba's texture coordinates of a triangle without any are its barycentric ones.
TEST(MitsubaReader, TexturedMeshWithoutTextureCoordinatesGetsBarycentricOnes) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        "<shape type=\"ply\"><string name=\"filename\" value=\"bare.ply\"/>"
        "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\">"
        "<string name=\"filename\" value=\"image.tga\"/></texture></bsdf></shape>"
        "<shape type=\"ply\"><string name=\"filename\" value=\"bare.ply\"/></shape>");
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_TRUE(scene.meshes.at(scene.instances.at(1).mesh).uvs.empty());
}

TEST(MitsubaReader, TexturesOfOtherKindsAreGrey) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        rectangle("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"marble\"/></bsdf>"));
    EXPECT_EQ(diffuse_albedo(only_material(scene)), glm::vec3(0.5F));
    EXPECT_EQ(folder.warnings(), Strings{"1 texture: type 'marble' is not supported, grey 0.5 is "
                                         "used; at s.xml:2"});
}

TEST(MitsubaReader, RendersOtherSurfacesAsDiffuseWithTheBestColour) {
    MitsubaFolder folder;
    const auto albedo = [&](const std::string& bsdf) {
        return diffuse_albedo(only_material(folder.read(rectangle(bsdf))));
    };
    const std::string plastic =
        "<bsdf type=\"plastic\"><rgb name=\"diffuse_reflectance\" value=\"0.1\"/>"
        "<rgb name=\"specular_reflectance\" value=\"0.9\"/><float name=\"int_ior\" value=\"1.9\"/>"
        "</bsdf>";
    EXPECT_EQ(albedo(plastic), glm::vec3(0.1F));
    EXPECT_EQ(folder.warnings(), Strings{}) << "it is described";
    EXPECT_EQ(albedo("<bsdf type=\"principled\"><rgb name=\"base_color\" value=\"0.2\"/></bsdf>"),
              glm::vec3(0.2F));
    EXPECT_EQ(albedo("<bsdf type=\"conductor\"><string name=\"material\" value=\"Au\"/></bsdf>"),
              glm::vec3(0.5F));
    EXPECT_EQ(
        albedo("<bsdf type=\"mask\"><float name=\"opacity\" value=\"0.5\"/>" + plastic + "</bsdf>"),
        glm::vec3(0.1F));
    EXPECT_EQ(folder.warnings(), Strings{});
    const std::string felt = "<bsdf type=\"felt\"><rgb name=\"reflectance\" value=\"0.3\"/></bsdf>";
    EXPECT_EQ(albedo(felt), glm::vec3(0.3F));
    EXPECT_EQ(folder.warnings(),
              Strings{"1 bsdf: type 'felt' is not supported, rendered as diffuse; at s.xml:2"});
    (void)folder.read(rectangle(felt) + "\n" + rectangle(felt));
    EXPECT_EQ(
        folder.warnings(),
        Strings{"2 bsdfs: type 'felt' is not supported, rendered as diffuse; first: s.xml:2"});
}

TEST(MitsubaReader, ReadsRadianceAsMitsubaDoes) {
    MitsubaFolder folder;
    const auto emission = [&](const std::string& radiance) {
        return only_material(
                   folder.read(rectangle("<emitter type=\"area\">" + radiance + "</emitter>")))
            .emission.radiance;
    };
    EXPECT_EQ(emission(""), glm::vec3(1.0F));
    EXPECT_EQ(emission("<rgb name=\"radiance\" value=\"17, 12, 4\"/>"), glm::vec3(17, 12, 4));
    EXPECT_EQ(emission("<float name=\"radiance\" value=\"5\"/>"), glm::vec3(5.0F));
    EXPECT_EQ(emission("<spectrum name=\"radiance\" type=\"uniform\">"
                       "<float name=\"value\" value=\"4\"/></spectrum>"),
              glm::vec3(4.0F));
    // A bare number is a constant spectrum there, which is not white in Rec.709.
    expect_near(emission("<spectrum name=\"radiance\" value=\"5\"/>"),
                {6.0239697, 4.741455, 4.5445805}, 1e-5);
    EXPECT_TRUE(folder.warnings().empty());
}

TEST(MitsubaReader, ReadsLightsWithoutArea) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        "<emitter type=\"point\"><point name=\"position\" x=\"1\" y=\"2\" z=\"3\"/>"
        "<rgb name=\"intensity\" value=\"2\"/></emitter>"
        "<emitter type=\"point\" id=\"bulb\"><transform name=\"to_world\">"
        "<translate value=\"4,5,6\"/></transform></emitter>"
        "<emitter type=\"directional\"><vector name=\"direction\" z=\"-2\"/>"
        "<rgb name=\"irradiance\" value=\"3\"/></emitter>"
        "<emitter type=\"directional\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/>"
        "</transform></emitter>"
        "<emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"40\"/></emitter>"
        "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.5\"/></emitter>");
    ASSERT_EQ(scene.lights.size(), 5U);
    EXPECT_EQ(scene.lights[0].type, LightType::point);
    expect_near(scene.lights[0].position, {1, 2, 3});
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(2.0F));
    expect_near(scene.lights[1].position, {4, 5, 6});
    EXPECT_EQ(scene.lights[1].name, "bulb");
    EXPECT_EQ(scene.lights[2].type, LightType::directional);
    expect_near(scene.lights[2].direction, {0, 0, -1});
    EXPECT_EQ(scene.lights[2].intensity, glm::vec3(3.0F));
    expect_near(scene.lights[3].direction, {0, -1, 0});
    EXPECT_EQ(scene.lights[4].type, LightType::spot);
    expect_near(scene.lights[4].direction, {0, 0, 1});
    EXPECT_NEAR(scene.lights[4].cos_outer, std::cos(glm::radians(40.0F)), 1e-6F);
    EXPECT_NEAR(scene.lights[4].cos_inner, std::cos(glm::radians(30.0F)), 1e-6F);
    EXPECT_TRUE(scene.lights[4].linear_edge);
    EXPECT_EQ(scene.environment->radiance, glm::vec3(0.5F));
    EXPECT_TRUE(folder.warnings().empty());
}

TEST(MitsubaReader, ReadsOrthographicSensors) {
    MitsubaFolder folder;
    const auto camera = [&](const std::string& inside) {
        const Scene scene = folder.read("<sensor type=\"orthographic\">" + inside + "</sensor>");
        return scene.cameras.at(0);
    };
    const Camera plain = camera("");
    EXPECT_TRUE(plain.orthographic());
    EXPECT_EQ(plain.half_extent, glm::dvec2(1.0, 0.0));
    EXPECT_EQ(plain.near_plane, 0.01);
    const Camera scaled = camera(
        "<float name=\"near_clip\" value=\"0.5\"/><transform name=\"to_world\">"
        "<scale value=\"3\"/><translate x=\"7\"/></transform>");
    EXPECT_EQ(scaled.half_extent, glm::dvec2(3.0, 0.0));
    EXPECT_EQ(scaled.near_plane, 1.5);
    EXPECT_EQ(scaled.to_world[3].x, 7.0);
    EXPECT_TRUE(folder.warnings().empty() ||
                folder.warnings()[0].find("scales") == std::string::npos);
    const Camera uneven =
        camera("<transform name=\"to_world\"><scale x=\"2\" y=\"1\" z=\"1\"/></transform>");
    EXPECT_EQ(uneven.half_extent.x, 2.0);
    ASSERT_FALSE(folder.warnings().empty());
    EXPECT_NE(folder.warnings()[0].find("scales x and y of the sensor differently"),
              std::string::npos);
}

TEST(MitsubaReader, PlacesTheSphereByCentreRadiusAndTransform) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        "<shape type=\"sphere\"><point name=\"center\" x=\"1\" y=\"2\" z=\"3\"/>"
        "<float name=\"radius\" value=\"2\"/><transform name=\"to_world\"><scale value=\"2\"/>"
        "<translate x=\"10\"/></transform></shape>");
    // Mitsuba meets this sphere at (12, 4, 10) from above.
    const glm::dvec3 top(scene.instances.at(0).to_world * glm::dvec4(0, 0, 1, 1));
    expect_near(top, {12, 4, 10});
}

TEST(MitsubaReader, FaceNormalsDropShadingNormals) {
    MitsubaFolder folder;
    const auto normals = [&](const std::string& more) {
        return folder
            .read("<shape type=\"ply\"><string name=\"filename\" value=\"normals.ply\"/>" + more +
                  "</shape>")
            .meshes.at(0)
            .normals.size();
    };
    EXPECT_EQ(normals(""), 4U);
    EXPECT_EQ(normals("<boolean name=\"face_normals\" value=\"true\"/>"), 0U);
}

}  // namespace
}  // namespace weft::mitsuba_reader_test
