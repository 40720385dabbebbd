// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "base/limits.h"
#include "tests/testing/mitsuba_folder.h"

namespace weft::mitsuba_include_test {
namespace {

std::string scene(const std::string& elements) {
    return "<scene version=\"3.0.0\">\n" + elements + "</scene>\n";
}

/// A bsdf of the reflectance `$level`.
std::string grey(const std::string& attributes = "") {
    return "<bsdf type=\"diffuse\" id=\"grey\"" + attributes +
           "><rgb name=\"reflectance\" value=\"$level\"/></bsdf>";
}

constexpr const char* use_grey = "<shape type=\"rectangle\"><ref id=\"grey\"/></shape>";

TEST(MitsubaInclude, DefaultsReachIntoIncludesAndOutOfThem) {
    MitsubaFolder folder;
    folder.folder().write("inner.xml", scene("<default name=\"level\" value=\"0.9\"/>"
                                             "<default name=\"kind\" value=\"rect\"/>"));
    folder.folder().write("outer.xml", scene("<include filename=\"inner.xml\"/>" + grey()));
    // The first value of a name counts, also one that is made of others, or within an object.
    const Scene read = folder.read(
        "<default name=\"part\" value=\"0.\"/><default name=\"level\" value=\"$part25\"/>"
        "<include filename=\"outer.xml\"/>"
        "<shape type=\"$kindangle\"><ref id=\"grey\"/></shape>"
        "<shape type=\"cube\"><default name=\"own\" value=\"0.5\"/>"
        "<bsdf type=\"diffuse\"><float name=\"reflectance\" value=\"$own\"/></bsdf></shape>");
    EXPECT_TRUE(folder.warnings().empty());
    ASSERT_EQ(read.instances.size(), 2U);
    EXPECT_EQ(diffuse_albedo(read.materials.at(0)), glm::vec3(0.25F));
    EXPECT_EQ(diffuse_albedo(read.materials.at(1)), glm::vec3(0.5F));
}

TEST(MitsubaInclude, TheLongestNameIsReplaced) {
    MitsubaFolder folder;
    const Scene read = folder.read(
        "<default name=\"a\" value=\"rect\"/><default name=\"ab\" value=\"sph\"/>"
        "<shape type=\"$aangle\"/><shape type=\"$abere\"/>");
    EXPECT_TRUE(folder.warnings().empty());
    EXPECT_EQ(read.instances.size(), 2U);
    const std::string error = folder.error("<shape type=\"$none_such\"/>");
    EXPECT_EQ(error,
              "s.xml:2: parameter '$none_such' is not defined, expected a <default> before it");
    EXPECT_NE(folder.error("<default name=\"\" value=\"1\"/>").find("of 0 bytes"),
              std::string::npos);
    EXPECT_NE(folder.error("<default name=\"" + std::string(1000, 'a') + "\" value=\"1\"/>")
                  .find("of 1000 bytes"),
              std::string::npos);
}

TEST(MitsubaInclude, AnObjectMayStandAloneInItsFile) {
    MitsubaFolder folder;
    folder.folder().write("grey.xml", grey(" version=\"3.0.0\""));
    const Scene read = folder.read(
        "<default name=\"level\" value=\"0.25\"/>"
        "<include filename=\"grey.xml\"/>" +
        std::string(use_grey));
    EXPECT_TRUE(folder.warnings().empty());
    EXPECT_EQ(diffuse_albedo(read.materials.at(0)), glm::vec3(0.25F));
    // Inside of an object, too.
    folder.folder().write("nested.xml",
                          "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.125\"/>"
                          "</bsdf>");
    const Scene nested =
        folder.read("<shape type=\"cube\"><include filename=\"nested.xml\"/></shape>");
    EXPECT_EQ(diffuse_albedo(nested.materials.at(0)), glm::vec3(0.125F));
    // The file itself has to be a scene.
    EXPECT_NE(folder.error_of_file(grey()), "no error");
}

TEST(MitsubaInclude, PathsAreSearchedForFiles) {
    MitsubaFolder folder;
    const std::string one = "<bsdf type=\"diffuse\" id=\"grey\"><rgb name=\"reflectance\" value=\"";
    folder.folder().write("parts/grey.xml", scene(one + "0.1\"/></bsdf>"));
    folder.folder().write("parts/more/grey.xml", scene(one + "0.2\"/></bsdf>"));
    const std::string include = "<include filename=\"grey.xml\"/>" + std::string(use_grey);
    const auto albedo = [&](const std::string& paths) {
        const Scene read = folder.read(paths + include);
        EXPECT_TRUE(folder.warnings().empty());
        return diffuse_albedo(read.materials.at(0)).r;
    };
    EXPECT_TRUE(folder.error(include).starts_with("s.xml:2: file 'grey.xml' cannot be opened"));
    EXPECT_EQ(albedo("<path value=\"parts\"/>"), 0.1F);
    // The last one first; one may lie in another.
    EXPECT_EQ(albedo("<path value=\"parts\"/><path value=\"more\"/>"), 0.2F);
    EXPECT_EQ(albedo("<path value=\"parts/more\"/><path value=\"parts\"/>"), 0.1F);
    // What none of them has lies beside the scene.
    folder.folder().write("white.xml", scene(one + "1\"/></bsdf>"));
    const Scene beside = folder.read("<path value=\"parts\"/><include filename=\"white.xml\"/>" +
                                     std::string(use_grey));
    EXPECT_EQ(diffuse_albedo(beside.materials.at(0)), glm::vec3(1.0F));
    // Shapes find their files there as well, and an included file's paths are relative to it.
    folder.folder().write("parts/index.xml", scene("<path value=\"more\"/>"));
    folder.folder().write("parts/more/tiny.ply",
                          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                          "float y\nproperty float z\nelement face 1\nproperty list uchar int "
                          "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const Scene shapes = folder.read(
        "<shape type=\"ply\"><string name=\"filename\" value=\"tiny.ply\"/></shape>"
        "<include filename=\"parts/index.xml\"/>");
    EXPECT_EQ(shapes.meshes.at(0).triangles.size(), 1U);
}

TEST(MitsubaInclude, WrongPathsAreRefused) {
    MitsubaFolder folder;
    EXPECT_EQ(folder.error("<path value=\"none\"/>"),
              "s.xml:2: folder 'none' is missing, expected a folder of files");
    EXPECT_EQ(folder.error("<path value=\"image.tga\"/>"),
              "s.xml:2: folder 'image.tga' is missing, expected a folder of files");
    EXPECT_EQ(folder.error("<path/>"), "s.xml:2: <path> without attribute 'value', expected one");
    for (const char* outside : {"..", "/tmp", "a/../..", "file:/tmp"})
        EXPECT_EQ(folder.error("<path value=\"" + std::string(outside) + "\"/>")
                      .substr(0, 20 + std::string(outside).size()),
                  "s.xml:2: reference '" + std::string(outside))
            << outside;
    EXPECT_EQ(folder.error("<shape type=\"cube\"><path value=\".\"/></shape>"),
              "s.xml:2: <path> inside of an object, expected it in the <scene>");
    std::string many;
    for (std::size_t i = 0; i <= limits::max_xml_includes; ++i) many += "<path value=\".\"/>";
    EXPECT_EQ(folder.error(many), "s.xml:2: more than 256 <path>s");
}

TEST(MitsubaInclude, IncludesMayNotBeNestedTooDeep) {
    MitsubaFolder folder;
    for (int i = 0; i < 200; ++i)
        folder.folder().write("i" + std::to_string(i) + ".xml",
                              scene("<include filename=\"i" + std::to_string(i + 1) + ".xml\"/>"));
    const std::string error = folder.error("<include filename=\"i0.xml\"/>");
    EXPECT_NE(error.find("elements nested deeper than 128 levels"), std::string::npos) << error;
}

}  // namespace
}  // namespace weft::mitsuba_include_test
