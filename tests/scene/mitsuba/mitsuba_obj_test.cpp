// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "scene/mitsuba/mitsuba_reader.h"
#include "tests/testing/temporary_folder.h"

namespace weft::mitsuba_obj_test {
namespace {

/// Two triangles that meet at a right angle in the edge from the first corner to the second, with
/// texture coordinates, and a polygon's worth of materials to be ignored.
constexpr const char* corner_obj =
    "mtllib none.mtl\nusemtl none\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "vt 0.25 0.125\nf 1/1 2/1 3/1\nusemtl other\nf 1/1 4/1 2/1\n";

Scene read(const std::string& properties, const std::string& obj = corner_obj) {
    const TemporaryFolder folder;
    folder.write("c.obj", obj);
    Diagnostics diagnostics;
    const Scene scene =
        read_mitsuba(folder.write("s.xml",
                                  "<scene version=\"3.0.0\">\n<shape type=\"obj\"><string "
                                  "name=\"filename\" value=\"c.obj\"/>" +
                                      properties + "</shape>\n</scene>\n"),
                     diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty()) << diagnostics.warnings()[0];
    return scene;
}

TEST(MitsubaObj, IsOneSmoothMesh) {
    const Scene scene = read("");
    ASSERT_EQ(scene.meshes.size(), 1U);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.name, "c");
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_TRUE(mesh.colours.empty());
    ASSERT_EQ(mesh.positions.size(), 4U);
    ASSERT_EQ(mesh.normals.size(), 4U);
    // Shared corners bend half way; both angles at the first one are right angles.
    EXPECT_EQ(mesh.positions[0], glm::vec3(0, 0, 0));
    EXPECT_NEAR(mesh.normals[0].y, 0.70710678F, 1e-6F);
    EXPECT_NEAR(mesh.normals[0].z, 0.70710678F, 1e-6F);
    EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, 1));
}

TEST(MitsubaObj, FacetsWhereAsked) {
    EXPECT_TRUE(
        read("<boolean name=\"face_normals\" value=\"true\"/>").meshes.at(0).normals.empty());
}

TEST(MitsubaObj, FlipsTextureCoordinatesByDefault) {
    EXPECT_EQ(read("").meshes.at(0).uvs.at(0), glm::vec2(0.25F, 0.875F));
    EXPECT_EQ(read("<boolean name=\"flip_tex_coords\" value=\"false\"/>").meshes.at(0).uvs.at(0),
              glm::vec2(0.25F, 0.125F));
}

TEST(MitsubaObj, NamesThePlaceOfErrors) {
    try {
        (void)read("", "v 0 0 0\nf 1 1 2\n");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("c.obj:2: vertex 2 does not exist"),
                  std::string::npos)
            << error.what();
    }
    try {
        (void)read(
            "<string name=\"unused\" value=\"\"/><float name=\"face_normals\" value=\"1\"/>");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("s.xml:2: "), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace weft::mitsuba_obj_test
