// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/obj/obj_polygon.h"
#include "scene/validate_scene.h"
#include "tests/testing/temporary_folder.h"

namespace weft::obj_reader_test {
namespace {

struct Reading {
    Scene scene;
    std::vector<std::string> warnings;
};

Reading read(const std::string& text) {
    const TemporaryFolder folder;
    Diagnostics diagnostics;
    Reading reading;
    reading.scene = read_obj(folder.write("m.obj", text), diagnostics);
    reading.warnings = diagnostics.warnings();
    validate_scene(reading.scene);
    return reading;
}

/// The only mesh of a file.
Mesh mesh_of(const std::string& text) {
    const Reading reading = read(text);
    EXPECT_EQ(reading.scene.meshes.size(), 1U);
    return reading.scene.meshes.empty() ? Mesh() : reading.scene.meshes[0];
}

std::string after_name(const std::string& text) {
    return text.substr(std::min(text.find("m.obj"), text.size()));
}

/// A message without the folder of the file.
std::string without_folder(const std::string& text) {
    const std::size_t name = text.find("m.obj");
    const std::size_t folder = text.find('/');
    if (name == std::string::npos || folder > name) return text;
    return text.substr(0, folder) + text.substr(name);
}

std::string error_of(const std::string& text) {
    try {
        (void)read(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return after_name(error.what());
    }
    return "no error";
}

double area_of(const Mesh& mesh) {
    double area = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        area += 0.5 *
                static_cast<double>(glm::length(glm::cross(mesh.positions[b] - mesh.positions[a],
                                                           mesh.positions[c] - mesh.positions[a])));
    return area;
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjReader, ReadsATriangle) {
    const Mesh mesh = mesh_of(square + "f 1 2 3\n");
    ASSERT_EQ(mesh.positions.size(), 3U);
    EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
    EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_TRUE(mesh.uvs.empty());
    EXPECT_TRUE(mesh.colours.empty());
}

TEST(ObjReader, ReadsEveryFormOfCorners) {
    const std::string tables = square + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\n";
    for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1",
                             "f -4 -3 -2", "f -4/-3/-1 -3/-2/-1 -2/-1/-1", "f 1/ 2/ 3/",
                             "f 1// 2// 3//", "f\t+1  2\t3 # tail", "fo 1 2 3"}) {
        const Mesh mesh = mesh_of(tables + face);
        ASSERT_EQ(mesh.triangles.size(), 1U) << face;
        EXPECT_EQ(mesh.positions[mesh.triangles[0][1]], glm::vec3(1, 0, 0)) << face;
        const bool has_normals =
            std::string(face).ends_with("1") && std::string(face).find('/') != std::string::npos;
        EXPECT_EQ(mesh.normals.size(), has_normals ? 3U : 0U) << face;
        if (has_normals) {
            EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1)) << face;
        }
    }
}

TEST(ObjReader, AcceptsFacesBeforeTheirVertices) {
    const Mesh mesh = mesh_of("f 1 2 3\n" + square);
    EXPECT_DOUBLE_EQ(area_of(mesh), 0.5);
}

TEST(ObjReader, ReadsEveryKindOfLine) {
    for (const char* text :
         {"v 0 0 0\rv 1 0 0\rv 1 1 0\rf 1 2 3\r", "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nf 1 2 3",
          "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\n\n  \t\n   v\t1 1 0\n#c\n  # c \\\nf 1 2 3",
          "v 0 0 \\\n0\nv 1 0\\\r\n 0\nv 1 1 0\nf \\\n 1\\\n 2 \\\n\t3 \\\n",
          "v 0 0 0 1.0 # w\n"
          "v 1.0e0 +0 0\nv 1 1 -0\nf 1 2 3\n\n\n"}) {
        const Mesh mesh = mesh_of(text);
        EXPECT_DOUBLE_EQ(area_of(mesh), 0.5) << text;
    }
    // A statement of many lines is named by its first.
    EXPECT_EQ(error_of("v 0 0 0\n\nf 1 \\\n2 \\\nx\n"),
              "m.obj:3: bad corner 'x', expected v, v/vt, v//vn or v/vt/vn with integers");
}

TEST(ObjReader, ReadsAVeryLongLine) {
    std::string text = "f";
    constexpr int count = 5000;
    for (int i = 1; i <= count; ++i) text += " " + std::to_string(i);
    for (int i = 0; i < count; ++i) {
        const double angle = glm::two_pi<double>() * i / count;
        text +=
            "\nv " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0";
    }
    const Mesh mesh = mesh_of(text);
    EXPECT_EQ(mesh.triangles.size(), count - 2U);
    EXPECT_NEAR(area_of(mesh), glm::pi<double>(), 1e-4);
}

TEST(ObjReader, SharesVerticesOnlyWhereAllAgrees) {
    const std::string two = square + "f 1 2 3\nf 1 3 4\n";
    EXPECT_EQ(mesh_of(two).positions.size(), 4U);
    const Mesh creased =
        mesh_of(square + "vn 0 0 1\nvn 0 1 1\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n");
    EXPECT_EQ(creased.positions.size(), 6U);
}

TEST(ObjReader, FacesWithoutNormalsStayFlatAmongOthers) {
    const Mesh mesh = mesh_of(square +
                              "v 0 0 1\nvn 1 0 1\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1 4 5\n"
                              "f 1//2 2//2 3//2\n");
    ASSERT_EQ(mesh.triangles.size(), 3U);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_NEAR(mesh.normals[mesh.triangles[0][0]].x, std::sqrt(0.5F), 1e-6F);
    EXPECT_EQ(mesh.normals[mesh.triangles[1][0]], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.normals[mesh.triangles[2][0]], glm::vec3(0, 0, 1));
}

TEST(ObjReader, TurnsTrianglesTowardsTheirNormals) {
    const Mesh mesh = mesh_of(square + "vn 0 0 -1\nf 1//1 2//1 3//1\n");
    const auto& [a, b, c] = mesh.triangles[0];
    EXPECT_LT(
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z,
        0.0F);
}

TEST(ObjReader, CutsConcavePolygonsInsideTheirOutline) {
    // An arrow head whose notch lies in any plane; a fan from the first corner would leave it.
    for (const char* notch :
         {"v 0 0 0\nv 4 -3 0\nv 1 0 0\nv 4 3 0\n", "v 0 0 0\nv 0 4 -3\nv 0 1 0\nv 0 4 3\n",
          "v 0 0 0\nv -3 0 4\nv 0 0 1\nv 3 0 4\n"}) {
        for (const char* face : {"f 1 2 3 4", "f 2 3 4 1", "f 3 4 1 2", "f 4 3 2 1"}) {
            const Mesh mesh = mesh_of(std::string(notch) + face);
            EXPECT_EQ(mesh.triangles.size(), 2U);
            EXPECT_NEAR(area_of(mesh), 3.0, 1e-6) << notch << face;
        }
    }
}

TEST(ObjReader, CutsCombsAndBridgedHoles) {
    // A square ring: outer corners 1-4, inner ones 5-8 backwards, joined by a bridge.
    const Mesh ring = mesh_of(
        "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 1 2 0\nv 2 2 0\nv 2 1 0\n"
        "f 1 2 3 4 1 5 6 7 8 5\n");
    EXPECT_EQ(ring.triangles.size(), 8U);
    EXPECT_NEAR(area_of(ring), 8.0, 1e-6);
    std::string comb = "v 0 -1 7\n";
    std::string face = "f 1";
    constexpr int teeth = 50;
    for (int i = 0; i < 2 * teeth; ++i) {
        comb += "v " + std::to_string(i) + (i % 2 == 0 ? " 0 7\n" : " 10 7\n");
        face = "f " + std::to_string(i + 2) + face.substr(1);
    }
    comb += "v " + std::to_string(2 * teeth - 1) + " -1 7\n";
    const Mesh mesh = mesh_of(comb + face + " " + std::to_string(2 * teeth + 2));
    EXPECT_EQ(mesh.triangles.size(), 2U * teeth);
    // The zigzag takes half of its box, above a strip of height 1.
    EXPECT_NEAR(area_of(mesh), (2 * teeth - 1) * 6.0, 1e-3);
}

TEST(ObjReader, CutsPolygonsThatCrossThemselvesOrHaveNoArea) {
    PolygonCutter cutter;
    const std::vector<glm::dvec3> bow{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
    EXPECT_EQ(cutter.cut(bow).size(), 3U);
    const std::vector<glm::dvec3> line(7, glm::dvec3(1.0));
    EXPECT_EQ(cutter.cut(line).size(), 5U);
    EXPECT_EQ(cutter.given_up(), 0U);
}

TEST(ObjReader, MakesOneMeshOfAMaterialWhereverItsFacesAre) {
    const std::string text = square +
                             "o a\nusemtl x\nf 1 2 3\no b\nusemtl y\nf 1 2 3\n"
                             "g c\nusemtl x\nf 1 3 4\nusemtl never used\nusemtl y\n";
    const Reading reading = read(text);
    // Neither is defined, so both are the default material.
    EXPECT_EQ(reading.scene.meshes.size(), 1U);
    EXPECT_EQ(reading.scene.materials.size(), 1U);
    ASSERT_EQ(reading.warnings.size(), 1U);
    EXPECT_EQ(without_folder(reading.warnings[0]),
              "2 materials: no MTL file defines it, grey is rendered instead; first: m.obj:7 'x'");
    // What follows from a missing file is not told again.
    const Reading without_file = read("mtllib m.mtl\n" + text);
    ASSERT_EQ(without_file.warnings.size(), 1U);
    EXPECT_EQ(without_folder(without_file.warnings[0]),
              "1 MTL file: the file is missing, its materials are replaced by grey; at m.obj:1 "
              "'m.mtl'");
}

TEST(ObjReader, ReadsVertexColours) {
    const Reading reading =
        read("v 0 0 0 1 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 2 -1 1\nv 0 1 0\nf 1 2 3 4\n");
    const Mesh& mesh = reading.scene.meshes.at(0);
    ASSERT_EQ(mesh.colours.size(), 4U);
    EXPECT_EQ(mesh.colours[0], glm::vec3(1, 0, 0));
    EXPECT_NEAR(mesh.colours[1].g, 0.21404F, 1e-4F);
    EXPECT_EQ(mesh.colours[2], glm::vec3(1, 0, 1));
    EXPECT_EQ(mesh.colours[3], glm::vec3(1, 1, 1));
    EXPECT_EQ(diffuse_albedo(reading.scene.materials.at(0)), glm::vec3(1.0F));
    ASSERT_EQ(reading.warnings.size(), 1U);
    EXPECT_EQ(without_folder(reading.warnings[0]),
              "1 vertex colour: outside of [0, 1], clamped; at m.obj:3");
}

TEST(ObjReader, LeavesOutWhatIsNotFinite) {
    const Reading reading = read("v nan 0 0\nv 1.#IND 0 0\nv 1e999 0 0\nv 1e-999 0 0\n" + square +
                                 "f 1 5 6\nf 2 5 6\nf 3 5 6\nf 4 6 7\n");
    EXPECT_EQ(reading.scene.meshes.at(0).triangles.size(), 1U);
    ASSERT_EQ(reading.warnings.size(), 1U);
    EXPECT_EQ(without_folder(reading.warnings[0]),
              "3 faces: a vertex is not finite, left out; first: m.obj:9");
}

TEST(ObjReader, WarnsOnceOfEachKind) {
    const Reading reading = read(square +
                                 "l 1 2\np 1\nl 2 3\ncurv 0 1 1 2\ncurv 0 1 1 2\nbmat u 1\n"
                                 "f 1 2\nf 1\nf 1/1/1 2/2/2 3/3/3\ns 1\ng\no\n");
    std::vector<std::string> warnings;
    for (const std::string& warning : reading.warnings) warnings.push_back(without_folder(warning));
    EXPECT_EQ(
        warnings,
        (std::vector<std::string>{
            "3 statements: points and lines are not simulated, they are left out; first: m.obj:5",
            "m.obj:8: statement 'curv' is not known, ignored (and at 1 more place)",
            "m.obj:10: statement 'bmat' is not known, ignored",
            "m.obj: faces name texture coordinates or normals of which the file has none, "
            "they are ignored",
            "2 faces: fewer than three corners, left out; at m.obj:11"}));
    EXPECT_EQ(reading.scene.meshes.at(0).triangles.size(), 1U);
}

TEST(ObjReader, RefusesWhatHoldsNoSurface) {
    for (const char* text :
         {"", "\n", "v 1 2 3\n", "v 0 0 0\nv 1 0 0\nl 1 2\n", "Dear reader,\nthis is no mesh.\n"})
        EXPECT_EQ(error_of(text), "m.obj: holds no faces that can be rendered, expected a mesh")
            << text;
}

TEST(ObjReader, TakesNulsAfterTheText) {
    for (const std::string& end :
         {std::string("\0", 1), std::string("\0\n", 2), std::string("\n\0\0\r\n", 5)})
        EXPECT_EQ(mesh_of(square + "f 1 2 3" + end).triangles.size(), 1U);
}

TEST(ObjReader, RefusesWhatIsWrong) {
    EXPECT_EQ(error_of("v 0 0 0\nv 1 x 0\n"), "m.obj:2: bad number 'x', expected a decimal number");
    EXPECT_EQ(error_of("v 0 0\n"), "m.obj:1: 2 numbers after 'v', expected 3");
    EXPECT_EQ(error_of("vt\n"), "m.obj:1: 0 numbers after 'vt', expected 1");
    EXPECT_EQ(error_of(square + "f 1 2 5\n"), "m.obj:5: vertex 5 does not exist, expected 1 to 4");
    EXPECT_EQ(error_of(square + "vt 0 0\nf 1/1 2/1 3/2\n"),
              "m.obj:6: texture coordinate 2 does not exist, expected 1 to 1");
    EXPECT_EQ(error_of(square + "vn 0 0 1\nf 1//1 2//1 3//2\n"),
              "m.obj:6: normal 2 does not exist, expected 1 to 1");
    for (const char* corner : {"0", "-5", "99999999999", "-9223372036854775808"})
        EXPECT_TRUE(error_of(square + "f 1 2 " + corner)
                        .starts_with("m.obj:5: index " + std::string(corner) + " of corner"))
            << corner;
    for (const char* corner : {"1.5", "/1", "1/2/3/4", "9223372036854775808", "1/x", "--1"})
        EXPECT_TRUE(error_of(square + "f 1 2 " + corner).starts_with("m.obj:5: bad corner"))
            << corner;
    EXPECT_EQ(error_of(std::string("v 1 2 3\nv \0 1", 13)),
              "m.obj:2: holds a NUL byte, expected a text file");
    EXPECT_EQ(error_of("v 1e20 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3"),
              "m.obj: instance 'default' lies too far from the origin");
}

TEST(ObjReader, FlipsTextureCoordinatesOfMeshesWhereAsked) {
    const TemporaryFolder folder;
    const auto path = folder.write("m.obj", square +
                                                "vt 0.25 0.75\nvt 1\nusemtl a\n"
                                                "f 1/1 2/2 3/2\nusemtl b\nf 1/1 3/2 4/1\n");
    Diagnostics diagnostics;
    const Mesh flipped = read_obj_mesh(path, "s.xml:1", true, diagnostics);
    const Mesh kept = read_obj_mesh(path, "s.xml:1", false, diagnostics);
    EXPECT_EQ(flipped.name, "m");
    EXPECT_EQ(flipped.triangles.size(), 2U);
    EXPECT_EQ(kept.uvs[kept.triangles[0][0]], glm::vec2(0.25F, 0.75F));
    EXPECT_EQ(flipped.uvs[flipped.triangles[0][0]], glm::vec2(0.25F, 0.25F));
    EXPECT_EQ(flipped.uvs[flipped.triangles[0][1]], glm::vec2(1.0F, 1.0F));
    EXPECT_TRUE(diagnostics.warnings().empty());
    try {
        (void)read_obj_mesh(folder.path() / "none.obj", "s.xml:1", true, diagnostics);
        FAIL();
    } catch (const Error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("s.xml:1: ")) << error.what();
    }
}

}  // namespace
}  // namespace weft::obj_reader_test
