// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_surface.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "scene/obj/obj_reader.h"
#include "scene/validate_scene.h"
#include "tests/testing/temporary_folder.h"

namespace weft::obj_surface_test {
namespace {

/// A TGA image of 1 x 2 pixels with alpha: red and half there, above blue.
std::string transparent_image() {
    std::string tga(18, '\0');
    tga[2] = 2;
    tga[12] = 1;
    tga[14] = 2;
    tga[16] = 32;
    tga[17] = 0x28;
    return tga + std::string("\x00\x00\xFF\x80\xFF\x00\x00\xFF", 8);
}

/// The same without alpha.
std::string opaque_image() {
    std::string tga(18, '\0');
    tga[2] = 2;
    tga[12] = 1;
    tga[14] = 2;
    tga[16] = 24;
    tga[17] = 0x20;
    return tga + std::string("\x00\x00\xFF\xFF\x00\x00", 6);
}

constexpr const char* square =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
constexpr const char* tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

struct Reading {
    Scene scene;
    std::vector<std::string> warnings;
};

Reading read(const std::string& mtl, const std::string& mesh = square,
             MaterialDetail detail = MaterialDetail::full) {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl a\n" + mtl);
    folder.write("p.tga", opaque_image());
    folder.write("alpha.tga", transparent_image());
    Diagnostics diagnostics;
    Reading reading;
    reading.scene =
        read_obj(folder.write("m.obj", "mtllib m.mtl\nusemtl a\n" + mesh), diagnostics, detail);
    validate_scene(reading.scene);
    reading.warnings = diagnostics.warnings();
    return reading;
}

const std::optional<SurfaceDescription>& described(const Reading& reading) {
    return reading.scene.materials.at(0).description;
}

template <class Model>
Model model_of(const std::string& mtl, const std::string& mesh = square) {
    const Reading reading = read(mtl, mesh);
    EXPECT_TRUE(described(reading).has_value()) << mtl;
    if (!described(reading)) return {};
    const Model* const model = std::get_if<Model>(&described(reading)->model);
    EXPECT_NE(model, nullptr) << mtl;
    return model == nullptr ? Model{} : *model;
}

bool warned(const Reading& reading, const std::string& text) {
    for (const std::string& warning : reading.warnings)
        if (warning.find(text) != std::string::npos) return true;
    return false;
}

TEST(ObjSurface, PlainMaterialsAreNoMoreThanDiffuse) {
    for (const char* mtl : {"", "Kd 0.5 0.5 0.5\nKs 0 0 0\nNs 100\nillum 2\nd 1\nNi 1.45\n",
                            "Ke 1 1 1", "Ks 0 0 0\nillum 3", "Tr 0", "d 1"})
        EXPECT_FALSE(described(read(mtl)).has_value()) << mtl;
    EXPECT_FALSE(described(read("Ks 1 1 1\nPm 1", square, MaterialDetail::diffuse)).has_value());
}

TEST(ObjSurface, KsIsACoatOnKd) {
    const auto surface = model_of<SpecularSurface>("Kd 0.25 0.5 0.25\nKs 0.1 0.2 0.05\nNs 98");
    EXPECT_EQ(surface.diffuse.factor, glm::vec3(0.25F, 0.5F, 0.25F));
    EXPECT_EQ(surface.specular.factor, glm::vec3(0.1F, 0.2F, 0.05F));
    EXPECT_FALSE(surface.diffuse_is_scaled);
    EXPECT_NEAR(alpha_of(surface.roughness.value.factor, surface.roughness.scale), std::sqrt(0.02),
                1e-9);
    // Together they reflect no more than arrives, but some coat is left.
    EXPECT_NEAR(model_of<SpecularSurface>("Kd 0.75 0 0\nKs 0.5 0.5 0.25").specular.factor.b, 0.125F,
                1e-6F);
    EXPECT_NEAR(model_of<SpecularSurface>("Kd 1 1 1\nKs 0.5 0.5 0.5").specular.factor.g, 0.04F,
                1e-6F);
    EXPECT_EQ(model_of<SpecularSurface>("Kd 1 1 1\nKs 0.01 0.01 0.01").specular.factor.g, 0.01F);
}

TEST(ObjSurface, IlluminationModelsMakeMirrors) {
    for (const char* illum : {"3", "5", "8"}) {
        const auto mirror = model_of<SpecularSurface>(
            "Kd 0.2 0.2 0.2\nKs 0.9 0.9 0.9\nNs 5\nillum " + std::string(illum));
        EXPECT_EQ(mirror.specular.factor, glm::vec3(0.9F));
        EXPECT_EQ(alpha_of(mirror.roughness.value.factor, mirror.roughness.scale), 0.0);
    }
}

TEST(ObjSurface, GlassIsSolidWhereTheMeshIsClosed) {
    for (const char* illum : {"4", "6", "7", "9"}) {
        const std::string mtl = "Ni 1.5\nTf 0.5 1 0.25\nillum " + std::string(illum);
        const auto solid = model_of<DielectricSurface>(mtl, tetrahedron);
        EXPECT_EQ(solid.ior_inside, 1.5);
        EXPECT_EQ(solid.ior_outside, 1.0);
        EXPECT_EQ(solid.transmittance.factor, glm::vec3(0.5F, 1.0F, 0.25F));
        EXPECT_FALSE(solid.thin);
        EXPECT_FALSE(solid.local_index);
        EXPECT_TRUE(model_of<DielectricSurface>(mtl).thin);
    }
    // Transparent by its dissolve, and by a model that traces rays.
    EXPECT_EQ(described(read("d 0.3\nNi 1.5\nillum 5"))->model.index(),
              SurfaceModel(DielectricSurface{}).index());
    EXPECT_EQ(described(read("d 0.3\nNi 1.5\nillum 4"))->opacity.mode, OpacityMode::opaque)
        << "once is enough";
    // An index below 1, or none, is no interface.
    EXPECT_EQ(model_of<DielectricSurface>("illum 4").ior_inside, 1.0);
    EXPECT_EQ(model_of<DielectricSurface>("Ni 0.5\nillum 4").ior_inside, 1.0);
    EXPECT_EQ(model_of<DielectricSurface>("Ni 1e30\nillum 4").ior_inside, 100.0);
}

TEST(ObjSurface, DissolveIsCoverageElsewhere) {
    const Reading half = read("d -halo 0.5\nNi 1.5\nillum 2");
    EXPECT_TRUE(std::holds_alternative<LambertSurface>(described(half)->model));
    EXPECT_EQ(described(half)->opacity.mode, OpacityMode::blend);
    EXPECT_EQ(described(half)->opacity.alpha.factor, 0.5F);
    EXPECT_EQ(described(read("Tr 0.25"))->opacity.alpha.factor, 0.75F);
    EXPECT_EQ(described(read("Tr 0\nd 0.5"))->opacity.alpha.factor, 0.5F) << "d counts";
    EXPECT_EQ(described(read("d 7\nTr 0"))->opacity.alpha.factor, 1.0F);
    EXPECT_TRUE(warned(read("d -1"), "d lies outside of its range and is clamped"));
    // Images have it as alpha, as grey, or in the channel that they name.
    const auto channel = [](const std::string& map) {
        return described(read("map_d " + map))->opacity.alpha.map.channel;
    };
    EXPECT_EQ(channel("alpha.tga"), Channel::alpha);
    EXPECT_EQ(channel("p.tga"), Channel::luminance);
    EXPECT_EQ(channel("-imfchan r alpha.tga"), Channel::red);
    EXPECT_EQ(channel("-imfchan m p.tga"), Channel::alpha);
    const Reading masked = read("map_d alpha.tga");
    EXPECT_TRUE(masked.scene.textures.at(0).has_alpha);
    EXPECT_FALSE(masked.scene.textures.at(0).srgb);
}

TEST(ObjSurface, NewerDialectsHaveMetalAndRoughness) {
    const auto surface = model_of<MetallicSurface>(
        "Kd 0.9 0.6 0.3\nKs 1 1 1\nillum 7\nPr 0.25\nPm 0.75\nPc 0.5\nPcr 0.1");
    EXPECT_EQ(surface.base_colour.factor, glm::vec3(0.9F, 0.6F, 0.3F));
    EXPECT_EQ(surface.roughness.value.factor, 0.25F);
    EXPECT_EQ(surface.roughness.scale, RoughnessScale::roughness);
    EXPECT_EQ(surface.metallic.factor, 0.75F);
    EXPECT_EQ(surface.clearcoat.factor.factor, 0.5F);
    EXPECT_EQ(surface.clearcoat.roughness.value.factor, 0.1F);
    EXPECT_EQ(model_of<MetallicSurface>("Pr 0.5").metallic.factor, 0.0F);
    EXPECT_EQ(model_of<MetallicSurface>("Pm 1").roughness.value.factor, 1.0F);
    const auto mapped = model_of<MetallicSurface>("map_Pm -imfchan b p.tga\nmap_Pr p.tga");
    EXPECT_EQ(mapped.metallic.factor, 1.0F);
    EXPECT_EQ(mapped.metallic.map.channel, Channel::blue);
    EXPECT_EQ(mapped.roughness.value.map.channel, Channel::luminance);
    EXPECT_EQ(mapped.metallic.map.texture, mapped.roughness.value.map.texture);
}

TEST(ObjSurface, ReadsItsImages) {
    const Reading reading = read(
        "Kd 0.5 0.5 0.5\nmap_Kd -s 2 4 -o 0.5 0.25 p.tga\nKs 0.2 0.2 0.2\nmap_Ks p.tga\n"
        "map_Ns p.tga\nnorm -bm 0.5 p.tga\n");
    const auto& surface = std::get<SpecularSurface>(described(reading)->model);
    ASSERT_EQ(reading.scene.textures.size(), 2U) << "as colours, and as data";
    EXPECT_TRUE(reading.scene.textures[0].srgb);
    EXPECT_FALSE(reading.scene.textures[1].srgb);
    EXPECT_EQ(surface.diffuse.map.texture, 0);
    EXPECT_EQ(surface.specular.map.texture, 0);
    EXPECT_EQ(surface.roughness.value.map.texture, 1);
    EXPECT_EQ(surface.roughness.value.factor, 1000.0F) << "what a map of Ns goes up to";
    EXPECT_EQ(described(reading)->normal_map.map.texture, 1);
    EXPECT_EQ(described(reading)->normal_map.scale, 0.5F);
    EXPECT_FALSE(described(reading)->normal_map.mitsuba_frame);
    // The diffuse surface's own coordinates are those of the set after the transform.
    const Mesh& mesh = reading.scene.meshes.at(0);
    ASSERT_EQ(mesh.uv_sets.size(), 1U);
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
        const glm::dvec3 placed =
            surface.diffuse.map.to_uv * glm::dvec3(glm::dvec2(mesh.uv_sets[0][i]), 1.0);
        EXPECT_NEAR(placed.x, mesh.uvs[i].x, 1e-6);
        EXPECT_NEAR(placed.y, mesh.uvs[i].y, 1e-6);
        EXPECT_EQ(mesh.uv_sets[0][i].y, 1.0F - mesh.positions[i].y);
    }
    // A mesh without coordinates sees one texel.
    const Reading bare = read("norm p.tga", tetrahedron);
    EXPECT_EQ(bare.scene.meshes.at(0).uv_sets.at(0).size(),
              bare.scene.meshes.at(0).positions.size());
    // Without its image there is no map.
    EXPECT_FALSE(described(read("norm none.tga")).has_value());
}

TEST(ObjSurface, NumbersThatAreNoneAreIgnored) {
    for (const char* mtl : {"Ns nan", "Ni inf", "illum glass", "Pr", "Pm 1e999", "d x"}) {
        const Reading reading = read(mtl);
        EXPECT_FALSE(described(reading).has_value()) << mtl;
        EXPECT_TRUE(warned(reading, "1 number: not a finite number, ignored")) << mtl;
    }
    EXPECT_TRUE(warned(read("Pr -1\nPm 2"), "Pr lies outside of its range and is clamped"));
    EXPECT_EQ(model_of<MetallicSurface>("Pr 1e30\nPm -5").roughness.value.factor, 1.0F);
    EXPECT_EQ(model_of<SpecularSurface>("Ks 0.5 0.5 0.5\nNs 1e300").roughness.value.factor, 1e9F);
    EXPECT_EQ(model_of<SpecularSurface>("Ks 0.5 0.5 0.5\nNs -3").roughness.value.factor, 0.0F);
}

}  // namespace
}  // namespace weft::obj_surface_test
