// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Broken and malicious Mitsuba files: each is refused once, with its place.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/limits.h"
#include "tests/testing/mitsuba_folder.h"

namespace weft::mitsuba_hostile_test {
namespace {

using Strings = std::vector<std::string>;

std::string rectangle(const std::string& content) {
    return "<shape type=\"rectangle\">" + content + "</shape>";
}

/// Expects the error of these elements, the first of them on line 2, to begin with a text.
void expect_error(const std::string& elements, const std::string& start) {
    MitsubaFolder folder;
    const std::string error = folder.error(elements);
    EXPECT_EQ(error.substr(0, start.size()), start) << error;
}

void expect_file_error(const std::string& text, const std::string& start) {
    MitsubaFolder folder;
    const std::string error = folder.error_of_file(text);
    EXPECT_EQ(error.substr(0, start.size()), start) << error;
}

TEST(MitsubaHostile, BrokenXmlNamesItsLine) {
    expect_file_error("", "s.xml:1: broken XML: ");
    expect_file_error("no xml at all", "s.xml:1: broken XML: ");
    expect_file_error("<scene version=\"3.0.0\">\n<shape>\n</scene>", "s.xml:3: broken XML: ");
    expect_file_error("<scene version=\"3.0.0\">\n\n<shape type=\"cube></scene>",
                      "s.xml:3: broken XML: ");
    expect_file_error(std::string("<scene version=\"3.0.0\">\n<a\0/></scene>", 33),
                      "s.xml:2: broken XML: ");
    expect_file_error("<mesh/>", "s.xml:1: root element 'mesh', expected the <scene>");
    expect_file_error("<scene version=\"3.0.0\"/>\n<scene version=\"3.0.0\"/>",
                      "s.xml:2: a second root element");
}

TEST(MitsubaHostile, VersionsOtherThanTwoAndThreeAreRefused) {
    expect_file_error("<scene/>", "s.xml:1: <scene> without attribute 'version'");
    expect_file_error("\n<scene version=\"0.6.0\"/>", "s.xml:2: scene version '0.6.0', expected");
    expect_file_error("<scene version=\"30\"/>", "s.xml:1: scene version '30', expected");
    MitsubaFolder folder;
    EXPECT_EQ(folder.error_of_file("<scene version=\"2.1.0\"/>"), "no error");
}

TEST(MitsubaHostile, ExternalEntitiesAreNotExpanded) {
    MitsubaFolder folder;
    folder.folder().write("secret.txt", "cube");
    const std::string error = folder.error_of_file(
        "<!DOCTYPE scene [<!ENTITY e SYSTEM \"secret.txt\"><!ENTITY f \"cube\">]>\n"
        "<scene version=\"3.0.0\">\n<shape type=\"ply\">\n"
        "<string name=\"filename\" value=\"&e;&f;\"/></shape></scene>");
    EXPECT_EQ(error.rfind("s.xml:3: file '&e;&f;' cannot be opened", 0), 0U) << error;
}

TEST(MitsubaHostile, WrongNumbersNameTheirLine) {
    const auto scale = [](const std::string& attributes) {
        return "\n" +
               rectangle("<transform name=\"to_world\">\n<scale " + attributes + "/></transform>");
    };
    expect_error(scale("x=\"one\""), "s.xml:4: bad number 'one', expected a finite decimal");
    expect_error(scale("x=\"\""), "s.xml:4: bad number ''");
    expect_error(scale("x=\"1 2\""), "s.xml:4: bad number '1 2'");
    expect_error(scale("x=\"nan\""), "s.xml:4: bad number 'nan'");
    expect_error(scale("x=\"inf\""), "s.xml:4: bad number 'inf'");
    expect_error(scale("x=\"1e39\""), "s.xml:4: bad number '1e39'");
    expect_error(scale("x=\"0x10\""), "s.xml:4: bad number '0x10'");
    expect_error(scale("value=\"1 2\""), "s.xml:4: 'value' has 2 numbers");
    expect_error(scale("value=\"1 2 3 4\""), "s.xml:4: too many numbers");
    expect_error(
        "<sensor type=\"perspective\">\n<film type=\"hdrfilm\">\n"
        "<integer name=\"width\" value=\"1.5\"/></film></sensor>",
        "s.xml:4: bad number '1.5', expected an integer");
    expect_error(rectangle("\n<boolean name=\"flip_normals\" value=\"yes\"/>"),
                 "s.xml:3: bad boolean 'yes', expected true or false");
}

TEST(MitsubaHostile, WrongTransformsAreRefused) {
    const auto with = [](const std::string& step) {
        return rectangle("<transform name=\"to_world\">\n" + step + "</transform>");
    };
    expect_error(with("<scale z=\"0\"/>"), "s.xml:2: to_world cannot be inverted");
    expect_error(with("<matrix value=\"1 2 3\"/>"), "s.xml:3: matrix of 3 numbers");
    expect_error(with("<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\"/>"),
                 "s.xml:3: projective matrix");
    expect_error(with("<rotate angle=\"90\"/>"), "s.xml:3: rotation about a zero axis");
    expect_error(with("<rotate x=\"1\"/>"), "s.xml:3: <rotate> without attribute 'angle'");
    expect_error(with("<lookat origin=\"1,2,3\" target=\"1,2,3\" up=\"0,1,0\"/>"),
                 "s.xml:3: lookat origin and target are the same point");
    expect_error(with("<lookat origin=\"0,0,0\" target=\"0,5,0\" up=\"0,1,0\"/>"),
                 "s.xml:3: lookat 'up' is zero or along the view");
    expect_error(with("<float name=\"x\" value=\"1\"/>"),
                 "s.xml:3: element 'float' in a transform");
    expect_error(with("<translate x=\"1e20\"/>"), "s.xml:2: the shape reaches too far out");
    std::string huge;
    for (int i = 0; i < 10; ++i) huge += "<scale value=\"1e38\"/>";
    expect_error(with(huge), "s.xml:2: the transform overflows");
}

TEST(MitsubaHostile, WrongCamerasAreRefused) {
    const auto sensor = [](const std::string& content) {
        return "<sensor type=\"perspective\">" + content + "</sensor>";
    };
    expect_error(sensor("<float name=\"fov\" value=\"180\"/>"), "s.xml:2: fov of 180 degrees");
    expect_error(sensor("<float name=\"fov\" value=\"-1\"/>"), "s.xml:2: fov of -1 degrees");
    expect_error(sensor("<string name=\"fov_axis\" value=\"z\"/>"), "s.xml:2: fov_axis 'z'");
    expect_error(sensor("<float name=\"fov\" value=\"50\"/>"
                        "<string name=\"focal_length\" value=\"50mm\"/>"),
                 "s.xml:2: both fov and focal_length");
    expect_error(sensor("<string name=\"focal_length\" value=\"0mm\"/>"),
                 "s.xml:2: focal_length not above 0");
    expect_error(sensor("<transform name=\"to_world\"><scale x=\"0\"/></transform>"),
                 "s.xml:2: camera to_world cannot be inverted");
    expect_error(sensor("<transform name=\"to_world\"><rotate z=\"1\" angle=\"45\"/>"
                        "<scale x=\"3\"/></transform>"),
                 "s.xml:2: camera to_world shears");
    for (const char* width : {"0", "-5", "99999999", "99999999999999999999"}) {
        MitsubaFolder folder;
        const std::string error =
            folder.error(sensor("<film type=\"hdrfilm\"><integer name=\"width\" value=\"" +
                                std::string(width) + "\"/></film>"));
        EXPECT_EQ(error.rfind("s.xml:2: ", 0), 0U) << error;
    }
    expect_error(sensor("<film type=\"hdrfilm\"><integer name=\"width\" value=\"32768\"/>"
                        "<integer name=\"height\" value=\"32768\"/></film>"),
                 "s.xml:2: film of 32768 x 32768 pixels");
}

TEST(MitsubaHostile, WrongSurfacesAndLightsAreRefused) {
    const auto reflectance = [](const std::string& value) {
        return rectangle("<bsdf type=\"diffuse\">\n<rgb name=\"reflectance\" value=\"" + value +
                         "\"/></bsdf>");
    };
    expect_error(reflectance("1.5"), "s.xml:3: reflectance outside of its range");
    expect_error(reflectance("-0.1"), "s.xml:3: reflectance outside of its range");
    expect_error(reflectance("0.1 0.2"), "s.xml:3: bad colour '0.1 0.2', expected 1 or 3");
    expect_error(reflectance("#808080"), "s.xml:3: bad number '#808080'");
    expect_error(rectangle("\n<bsdf type=\"twosided\"/>"), "s.xml:3: twosided with 0 nested");
    expect_error(rectangle("<emitter type=\"area\">\n<rgb name=\"radiance\" value=\"-1\"/>"
                           "</emitter>"),
                 "s.xml:3: negative colour");
    expect_error(rectangle("\n<emitter type=\"point\"/>"),
                 "s.xml:3: emitter 'point' inside a shape");
    expect_error(rectangle("<bsdf type=\"diffuse\"/><bsdf type=\"diffuse\"/>"),
                 "s.xml:2: 2 nested <bsdf> elements");
    expect_error("<shape type=\"sphere\"><float name=\"radius\" value=\"0\"/></shape>",
                 "s.xml:2: sphere of radius 0");
    expect_error("<emitter type=\"directional\"><vector name=\"direction\"/></emitter>",
                 "s.xml:2: emitter without a direction");
    expect_error("<emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"-1\"/></emitter>",
                 "s.xml:2: bad spot angles");
    expect_error("\n<shape/>", "s.xml:3: <shape> without attribute 'type'");
    expect_error(rectangle("\n<float value=\"1\"/>"), "s.xml:3: <float> without attribute 'name'");
    expect_error(rectangle("<float name=\"a\" value=\"1\"/>\n<float name=\"a\" value=\"1\"/>"),
                 "s.xml:3: 'a' is given twice");
    expect_error(rectangle("<string name=\"to_world\" value=\"1\"/>"),
                 "s.xml:2: 'to_world' is a <string>, expected a <transform>");
}

TEST(MitsubaHostile, WrongReferencesAreRefused) {
    expect_error("\n" + rectangle("\n<ref id=\"nothing\"/>"),
                 "s.xml:4: reference to unknown id 'nothing'");
    expect_error("<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>",
                 "s.xml:3: id 'a' is already used at s.xml:2");
    expect_error(
        "<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>\n"
        "<bsdf type=\"mask\" id=\"b\"><ref id=\"a\"/></bsdf>" +
            rectangle("<ref id=\"a\"/>"),
        "s.xml:2: bsdf refers to itself");
    std::string chain = rectangle("<ref id=\"b0\"/>");
    for (int i = 0; i < 100000; ++i)
        chain += "<bsdf type=\"twosided\" id=\"b" + std::to_string(i) + "\"><ref id=\"b" +
                 std::to_string(i + 1) + "\"/></bsdf>";
    expect_error(chain + "<bsdf type=\"diffuse\" id=\"b100000\"/>", "s.xml:2: bsdfs nested deeper");
    expect_error(
        "\n<integrator type=\"path\"><integer name=\"a\" value=\"$no_such\"/></integrator>",
        "s.xml:3: parameter '$no_such' is not defined");
    expect_error("<integrator type=\"$\"/>", "s.xml:2: parameter '$' is not defined");
}

TEST(MitsubaHostile, FilesOutsideOfTheSceneFolderAreRefused) {
    const auto ply = [](const std::string& file) {
        return "<shape type=\"ply\">\n<string name=\"filename\" value=\"" + file + "\"/></shape>";
    };
    expect_error(ply("../a.ply"), "s.xml:3: reference '../a.ply' leaves its folder");
    expect_error(ply("/etc/passwd"), "s.xml:3: reference '/etc/passwd' is absolute");
    expect_error(ply("http://x/a.ply"), "s.xml:3: reference 'http://x/a.ply' is a URI");
    expect_error(ply(""), "s.xml:3: reference '' is empty");
    expect_error(ply("none.ply"), "s.xml:2: file 'none.ply' cannot be opened");
    expect_error(ply("image.tga"), "image.tga:1: ");
    expect_error("<shape type=\"ply\"/>", "s.xml:2: shape 'ply' without 'filename'");
    expect_error("<include filename=\"../x.xml\"/>", "s.xml:2: reference '../x.xml' leaves");
    expect_error(rectangle("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\">"
                           "<string name=\"filename\" value=\"none.png\"/></texture></bsdf>"),
                 "s.xml:2: file 'none.png' cannot be opened");
}

TEST(MitsubaHostile, IncludesAreFollowedButNotInCircles) {
    MitsubaFolder folder;
    folder.folder().write("part.xml", "<scene version=\"3.0.0\">" + rectangle("") + "</scene>");
    const std::string include = "<include filename=\"part.xml\"/>";
    EXPECT_EQ(folder.read(include + include).instances.size(), 2U);
    folder.folder().write("a.xml",
                          "<scene version=\"3.0.0\">\n<include filename=\"b.xml\"/></scene>");
    folder.folder().write("b.xml",
                          "<scene version=\"3.0.0\">\n\n<include filename=\"./a.xml\"/></scene>");
    const std::string cycle = folder.error("<include filename=\"a.xml\"/>");
    EXPECT_EQ(cycle.rfind("b.xml:3: file './a.xml' includes itself", 0), 0U) << cycle;
    const std::string self = folder.error("<include filename=\"s.xml\"/>");
    EXPECT_EQ(self.rfind("s.xml:2: file 's.xml' includes itself", 0), 0U) << self;
    std::string many;
    for (std::size_t i = 0; i <= limits::max_xml_includes; ++i) many += include;
    EXPECT_EQ(folder.error(many).rfind("s.xml:2: more than 256 includes", 0), 0U);
}

TEST(MitsubaHostile, BombsAreRefused) {
    std::string deep;
    for (int i = 0; i < 1000000; ++i) deep += "<bsdf>";
    expect_file_error("<scene version=\"3.0.0\">\n" + deep, "s.xml:2: broken XML: ");
    for (int i = 0; i < 1000000; ++i) deep += "</bsdf>";
    expect_error(deep, "s.xml:2: elements nested deeper than 128 levels");
    std::string laughs = "<default name=\"p0\" value=\"ha ha ha ha\"/>\n";
    for (int i = 1; i < 100; ++i) {
        const std::string last = "$p" + std::to_string(i - 1);
        laughs += "<default name=\"p" + std::to_string(i) + "\" value=\"" + last + last + last +
                  last + "\"/>\n";
    }
    MitsubaFolder folder;
    const std::string error = folder.error(laughs);
    EXPECT_NE(error.find("parameters expand to more than"), std::string::npos) << error;
    std::string wide = "<a ";
    while (wide.size() < 11 * limits::max_xml_items) wide += "a=''     \n";
    expect_error(wide + "/>", "s.xml:");
    EXPECT_NE(folder.error(wide + "/>").find("tags and attributes"), std::string::npos);
}

TEST(MitsubaHostile, UnknownThingsAreNamedOnceEach) {
    MitsubaFolder folder;
    const std::string shape =
        "<shape type=\"cube\" colour=\"red\">\n<float name=\"gloss\" value=\"1\"/>\n"
        "<teapot/>\nhello<bsdf type=\"diffuse\" id=\"I\"><string name=\"x\" value=\"y\"/></bsdf>"
        "</shape>\n<shape type=\"hair\"/><shape type=\"serialized\"/><sensor "
        "type=\"irradiancemeter\"/>"
        "<emitter type=\"projector\"/><emitter type=\"sunsky\"/>\n";
    std::string again = shape;
    again.replace(again.find("\"I\""), 3, "\"J\"");
    const Scene scene = folder.read(shape + again);
    EXPECT_EQ(scene.instances.size(), 2U);
    const Strings expected = {
        "s.xml:2: attribute 'colour' of <shape> is not known, ignored (and at 1 more place)",
        "s.xml:4: element 'teapot' is not known, ignored (and at 1 more place)",
        "s.xml:2: text between elements is ignored (and at 1 more place)",
        "s.xml:5: property 'x' of bsdf 'diffuse' is not supported, ignored (and at 1 more place)",
        "s.xml:3: property 'gloss' of shape 'cube' is not supported, ignored (and at 1 more place)",
        "2 shapes: type 'hair' is not supported, left out; first: s.xml:6",
        "2 shapes: type 'serialized' is not supported, left out; first: s.xml:6",
        "2 sensors: type 'irradiancemeter' is not supported, left out; first: s.xml:6",
        "2 emitters: type 'projector' is not supported, left out; first: s.xml:6",
        "2 emitters: type 'sunsky' is not supported, left out; first: s.xml:6",
    };
    EXPECT_EQ(folder.warnings(), expected);
}

TEST(MitsubaHostile, WarningsHaveAnEnd) {
    MitsubaFolder folder;
    std::string elements;
    for (int i = 0; i < 50000; ++i) elements += "<x" + std::to_string(i) + "/>\n";
    (void)folder.read(elements);
    EXPECT_EQ(folder.warnings().size(), limits::max_warnings + 1);
    EXPECT_EQ(folder.warnings().back(), "s.xml:202: further kinds of warnings are left out");
}

}  // namespace
}  // namespace weft::mitsuba_hostile_test
