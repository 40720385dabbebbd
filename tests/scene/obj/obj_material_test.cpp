// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/obj/obj_reader.h"
#include "scene/validate_scene.h"
#include "tests/testing/temporary_folder.h"

namespace weft::obj_material_test {
namespace {

/// A TGA image of 1 x 2 pixels: red above blue.
std::string red_above_blue() {
    std::string tga(18, '\0');
    tga[2] = 2;
    tga[12] = 1;
    tga[14] = 2;
    tga[16] = 24;
    tga[17] = 0x20;
    return tga + std::string("\x00\x00\xFF\xFF\x00\x00", 6);
}

struct Reading {
    Scene scene;
    std::vector<std::string> warnings;  ///< without folders
};

/// A square with texture coordinates, drawn with material `a`, next to the files given.
Reading read(const std::map<std::string, std::string>& files,
             const std::string& head = "mtllib m.mtl\nusemtl a\n",
             MaterialDetail detail = MaterialDetail::full) {
    const TemporaryFolder folder;
    for (const auto& [name, text] : files) folder.write(name, text);
    const auto path =
        folder.write("m.obj", head +
                                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                                  "vt 0 1\nf 1/1 2/2 3/3 4/4\n");
    Diagnostics diagnostics;
    Reading reading;
    reading.scene = read_obj(path, diagnostics, detail);
    validate_scene(reading.scene);
    const std::string prefix = folder.path().string() + "/";
    for (std::string text : diagnostics.warnings()) {
        if (text.find(prefix) != std::string::npos) text.erase(text.find(prefix), prefix.size());
        reading.warnings.push_back(text);
    }
    return reading;
}

Material material_of(const std::string& mtl, std::size_t warnings = 0) {
    const Reading reading = read({{"m.mtl", "newmtl a\n" + mtl}});
    EXPECT_EQ(reading.warnings.size(), warnings) << mtl;
    return reading.scene.materials.at(0);
}

std::string error_of(const std::string& mtl) {
    try {
        (void)material_of(mtl);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        const std::string text = error.what();
        return text.substr(std::min(text.find("m.mtl"), text.size()));
    }
    return "no error";
}

TEST(ObjMaterial, ReadsColours) {
    const Material material = material_of("  Kd 0.1 0.2 0.3\r\n\tKe 5 6 7 # area light\n");
    EXPECT_EQ(material.name, "a");
    EXPECT_EQ(diffuse_albedo(material), glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(material.emission.radiance, glm::vec3(5, 6, 7));
    EXPECT_TRUE(material.two_sided);
    EXPECT_TRUE(material.emission.both_sides);
    EXPECT_EQ(diffuse_albedo(material_of("kd 0.25")), glm::vec3(0.25F));
    EXPECT_EQ(diffuse_albedo(material_of("")), glm::vec3(0.8F));
    EXPECT_EQ(diffuse_albedo(material_of("Kd 2 0 -1", 1)), glm::vec3(1, 0, 0));
    EXPECT_EQ(diffuse_albedo(material_of("Kd spectral file.rfl 1", 1)), glm::vec3(0.8F));
}

TEST(ObjMaterial, RefusesWrongNumbers) {
    EXPECT_EQ(error_of("Kd 1 x 1"), "m.mtl:2: bad number 'x', expected a decimal number");
    EXPECT_EQ(error_of("\nKd"), "m.mtl:3: lacks its colour, expected r g b");
    EXPECT_EQ(error_of("Ke inf 0 0"), "m.mtl:2: colour that is not finite, expected r g b");
}

TEST(ObjMaterial, SaysOnceWhatIsNotSimulated) {
    const std::map<std::string, std::string> files{
        {"m.mtl",
         "newmtl a\nKa 1 1 1\nNs 10\nillum 2\nNi 1.5\nd 1\nTr 0\nKs 0 0 0\nKs 0.5 0.5 0.5\n"
         "map_Ks x.png\nd 0.5\nTr 0.5\nbump b.png\nmap_Bump b.png\nPm 0\nPm 1\nwhat 1\n"}};
    EXPECT_EQ(read(files).warnings,
              (std::vector<std::string>{
                  "1 material: bump and displacement maps are not simulated; at m.mtl:13",
                  "m.mtl:17: statement 'what' is not known, ignored"}));
    const std::string metals =
        "1 material: metals are not simulated, a diffuse surface is rendered instead; at m.mtl:16";
    EXPECT_EQ(read(files, "mtllib m.mtl\nusemtl a\n", MaterialDetail::diffuse).warnings,
              (std::vector<std::string>{
                  "1 material: specular reflection is not simulated; at m.mtl:9",
                  "1 material: transparency is not simulated, surfaces are opaque; at m.mtl:11",
                  "1 material: bump and displacement maps are not simulated; at m.mtl:13", metals,
                  "m.mtl:17: statement 'what' is not known, ignored"}));
}

TEST(ObjMaterial, PutsTheTopOfTheImageAtVOne) {
    const Reading reading = read({{"m.mtl", "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd tex\\my image.tga\n"},
                                  {"tex/my image.tga", red_above_blue()}});
    EXPECT_TRUE(reading.warnings.empty());
    const Texture& texture = reading.scene.textures.at(0);
    EXPECT_EQ(texture.rgba[0], 255);
    EXPECT_TRUE(texture.srgb);
    EXPECT_EQ(albedo_texture(reading.scene.materials.at(0)), 0);
    EXPECT_EQ(diffuse_albedo(reading.scene.materials.at(0)), glm::vec3(0.5F));
    const Mesh& mesh = reading.scene.meshes.at(0);
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
        EXPECT_EQ(mesh.uvs[i].x, mesh.positions[i].x);
        EXPECT_EQ(mesh.uvs[i].y, 1.0F - mesh.positions[i].y);
    }
}

TEST(ObjMaterial, AppliesTheOptionsOfAnImage) {
    const std::map<std::string, std::string> image{{"p.tga", red_above_blue()}};
    auto files = image;
    files["m.mtl"] = "newmtl a\nmap_Kd -blendu on -s 2 4 -o 0.5 0.25 0 -clamp on -bm 2 p.tga";
    const Reading reading = read(files);
    EXPECT_TRUE(reading.warnings.empty());
    EXPECT_EQ(reading.scene.textures.at(0).wrap_u, Wrap::clamp);
    EXPECT_EQ(reading.scene.textures.at(0).wrap_v, Wrap::clamp);
    const Mesh& mesh = reading.scene.meshes.at(0);
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
        EXPECT_FLOAT_EQ(mesh.uvs[i].x, 2.0F * mesh.positions[i].x + 0.5F);
        EXPECT_FLOAT_EQ(mesh.uvs[i].y, 1.0F - (4.0F * mesh.positions[i].y + 0.25F));
    }
    files["m.mtl"] = "newmtl a\nmap_Kd -mm 0.1 2 -t 1 1 1 -imfchan r p.tga";
    const Reading ignored = read(files);
    EXPECT_EQ(ignored.warnings.size(), 3U);
    EXPECT_EQ(ignored.scene.textures.size(), 1U);
    EXPECT_EQ(ignored.scene.textures[0].wrap_u, Wrap::repeat);
}

TEST(ObjMaterial, BlackUnderATextureCountsAsWhite) {
    const Reading reading =
        read({{"m.mtl", "newmtl a\nKd 0 0 0\nmap_Kd p.tga"}, {"p.tga", red_above_blue()}});
    EXPECT_EQ(diffuse_albedo(reading.scene.materials.at(0)), glm::vec3(1.0F));
    EXPECT_EQ(
        reading.warnings,
        (std::vector<std::string>{
            "1 material: black Kd would hide the texture, it is taken as white; at m.mtl:1"}));
    // Without a texture, black is black.
    EXPECT_EQ(diffuse_albedo(material_of("Kd 0 0 0")), glm::vec3(0.0F));
}

TEST(ObjMaterial, LivesWithoutItsImages) {
    for (const char* name :
         {"none.png", "../up.png", "/etc/passwd", "C:\\a\\b.png", "broken.png"}) {
        const Reading reading =
            read({{"m.mtl", "newmtl a\nKd 0.3 0.3 0.3\nmap_Kd " + std::string(name)},
                  {"broken.png", "no image"}});
        EXPECT_EQ(diffuse_albedo(reading.scene.materials.at(0)), glm::vec3(0.3F));
        EXPECT_TRUE(reading.scene.textures.empty());
        ASSERT_EQ(reading.warnings.size(), 1U) << name;
        EXPECT_TRUE(reading.warnings[0].starts_with("1 texture: ")) << reading.warnings[0];
        EXPECT_TRUE(reading.warnings[0].ends_with(", the plain colour is used; at m.mtl:3 '" +
                                                  std::string(name) + "'"))
            << reading.warnings[0];
    }
}

TEST(ObjMaterial, ReadsAnImageOnce) {
    const Reading reading = read(
        {{"m.mtl", "newmtl a\nmap_Kd p.tga\nnewmtl b\nmap_Kd p.tga\nnewmtl c\nmap_Kd none.png\n"},
         {"p.tga", red_above_blue()}},
        "mtllib m.mtl\nv 5 5 5\nv 6 5 5\nv 6 6 5\nusemtl b\nf 1 2 3\nusemtl a\n");
    EXPECT_EQ(reading.scene.textures.size(), 1U);
    EXPECT_EQ(reading.scene.materials.size(), 2U);
    // The material that no face uses is not made, so its image is not missed.
    EXPECT_TRUE(reading.warnings.empty());
}

TEST(ObjMaterial, EmitsByAMap) {
    const std::string emits = "newmtl a\nKe 2 2 2\nmap_Ke ";
    const Reading reading = read({{"m.mtl", emits + "p.tga"}, {"p.tga", red_above_blue()}});
    const Emission& emission = reading.scene.materials.at(0).emission;
    EXPECT_EQ(emission.radiance, glm::vec3(2.0F));
    EXPECT_EQ(emission.texture, 0);
    EXPECT_EQ(reading.scene.textures.size(), 1U);
    EXPECT_TRUE(reading.warnings.empty());
    const Mesh& mesh = reading.scene.meshes.at(0);
    ASSERT_EQ(mesh.emission_uvs.size(), mesh.positions.size());
    EXPECT_TRUE(mesh.uvs.empty());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_EQ(mesh.emission_uvs[i], glm::vec2(mesh.positions[i].x, 1.0F - mesh.positions[i].y));
    // Maps that are placed differently have coordinates of their own.
    const Reading both =
        read({{"m.mtl", emits + "-o 0.5 0 0 p.tga\nmap_Kd p.tga\n"}, {"p.tga", red_above_blue()}});
    const Mesh& placed = both.scene.meshes.at(0);
    ASSERT_EQ(placed.uvs.size(), placed.emission_uvs.size());
    for (std::size_t i = 0; i < placed.uvs.size(); ++i)
        EXPECT_EQ(placed.emission_uvs[i], placed.uvs[i] + glm::vec2(0.5F, 0.0F));
    const Reading alike =
        read({{"m.mtl", emits + "p.tga\nmap_Kd p.tga\n"}, {"p.tga", red_above_blue()}});
    EXPECT_TRUE(alike.scene.meshes.at(0).emission_uvs.empty());
    // A map that cannot be read leaves the colour.
    const Reading none = read({{"m.mtl", emits + "none.tga"}});
    EXPECT_EQ(none.scene.materials.at(0).emission.texture, -1);
    EXPECT_EQ(none.warnings.size(), 1U);
}

TEST(ObjMaterial, FindsItsFiles) {
    const std::string grey = "newmtl a\nKd 0.5 0.5 0.5\n";
    for (const char* name : {"my own file.mtl", "dir/x.mtl", "./x.mtl"}) {
        const Reading reading =
            read({{name, grey}}, "usemtl a\nmtllib " + std::string(name) + "\n");
        EXPECT_TRUE(reading.warnings.empty()) << name;
        EXPECT_EQ(diffuse_albedo(reading.scene.materials.at(0)), glm::vec3(0.5F)) << name;
    }
    const Reading several = read({{"x.mtl", "newmtl b\n"}, {"y z.mtl", grey}},
                                 "mtllib x.mtl none.mtl y\\ z.mtl\nusemtl a\n");
    EXPECT_EQ(diffuse_albedo(several.scene.materials.at(0)), glm::vec3(0.5F));
    EXPECT_EQ(several.warnings,
              (std::vector<std::string>{
                  "1 MTL file: the file is missing, its materials are replaced by grey; at m.obj:1 "
                  "'none.mtl'"}));
    for (const char* name : {"../m.mtl", "/m.mtl", "C:\\dir\\m.mtl"}) {
        const Reading refused = read({}, "mtllib " + std::string(name) + "\n");
        ASSERT_EQ(refused.warnings.size(), 1U) << name;
        EXPECT_EQ(diffuse_albedo(refused.scene.materials.at(0)), glm::vec3(0.8F));
    }
}

TEST(ObjMaterial, NamesMayHoldBlanksAndBeDefinedTwice) {
    const Reading reading =
        read({{"m.mtl", "Kd 1 1 1\nnewmtl a #1\nKd 0.5 0.5 0.5\nnewmtl a #1\nKd 0.25 0.25 0.25\n"}},
             "mtllib m.mtl\nusemtl a #1\n");
    EXPECT_EQ(diffuse_albedo(reading.scene.materials.at(0)), glm::vec3(0.5F));
    EXPECT_EQ(reading.warnings,
              (std::vector<std::string>{
                  "m.mtl:1: statements before the first 'newmtl' are ignored",
                  "1 material: defined twice, the first definition is used; at m.mtl:4 'a #1'"}));
}

}  // namespace
}  // namespace weft::obj_material_test
