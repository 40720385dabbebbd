// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/testing/temporary_folder.h"

namespace weft::ply_reader_test {
namespace {

const std::string position_properties = "property float x\nproperty float y\nproperty float z\n";
const std::string face_properties = "property list uchar int vertex_indices\n";

std::string header(const std::string& format, const std::string& rest) {
    return "ply\nformat " + format + " 1.0\n" + rest + "end_header\n";
}

std::string triangle_header(const std::string& format = "ascii") {
    return header(
        format, "element vertex 3\n" + position_properties + "element face 1\n" + face_properties);
}

const std::string triangle_body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

struct Reading {
    Mesh mesh;
    std::vector<std::string> warnings;
};

Reading read(const std::string& bytes) {
    const TemporaryFolder folder;
    Diagnostics diagnostics;
    Reading reading;
    reading.mesh = read_ply(folder.write("m.ply", bytes), "scene.xml:7", diagnostics);
    reading.warnings = diagnostics.warnings();
    return reading;
}

/// The error without the folder in front of the file name.
std::string error_of(const std::string& bytes) {
    try {
        (void)read(bytes);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        const std::string text = error.what();
        return text.substr(std::min(text.find("m.ply"), text.size()));
    }
    return "no error";
}

void expect_error(const std::string& bytes, const std::string& start) {
    const std::string error = error_of(bytes);
    EXPECT_EQ(error.substr(0, start.size()), start) << error;
}

/// Appends a value in the byte order asked for.
template <typename Value>
void put(std::string& bytes, Value value, bool big_endian) {
    std::array<char, sizeof(Value)> raw{};
    std::memcpy(raw.data(), &value, sizeof(Value));
    if (big_endian != (std::endian::native == std::endian::big))
        std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

TEST(PlyReader, ReadsAscii) {
    const Reading reading = read(triangle_header() + triangle_body);
    EXPECT_EQ(reading.mesh.name, "m");
    ASSERT_EQ(reading.mesh.positions.size(), 3U);
    EXPECT_EQ(reading.mesh.positions[1], glm::vec3(1, 0, 0));
    ASSERT_EQ(reading.mesh.triangles.size(), 1U);
    EXPECT_EQ(reading.mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
    EXPECT_TRUE(reading.mesh.normals.empty());
    EXPECT_TRUE(reading.mesh.uvs.empty());
    EXPECT_TRUE(reading.mesh.colours.empty());
    EXPECT_TRUE(reading.warnings.empty());
}

TEST(PlyReader, ReadsBothByteOrdersWithSkippedPropertiesAndElements) {
    for (const bool big_endian : {false, true}) {
        std::string bytes =
            header(big_endian ? "binary_big_endian" : "binary_little_endian",
                   "comment a list, a double and an element that nobody asked for\nobj_info x\n"
                   "element vertex 3\nproperty double x\nproperty list ushort short odd\n"
                   "property float y\nproperty int z\nproperty uchar quality\n"
                   "element edge 2\nproperty int a\nproperty list int double b\n"
                   "element face 1\nproperty float weight\nproperty list uint ushort vertex_index\n"
                   "property list uchar float texcoord\n");
        for (int i = 0; i < 3; ++i) {
            put(bytes, 1.5 * i, big_endian);
            put(bytes, static_cast<std::uint16_t>(i), big_endian);
            for (int k = 0; k < i; ++k) put(bytes, std::int16_t{-1}, big_endian);
            put(bytes, static_cast<float>(-i * i), big_endian);
            put(bytes, -70000 * i, big_endian);
            put(bytes, std::uint8_t{9}, big_endian);
        }
        for (int i = 0; i < 2; ++i) {
            put(bytes, 5, big_endian);
            put(bytes, 1, big_endian);
            put(bytes, 2.5, big_endian);
        }
        put(bytes, 0.25F, big_endian);
        put(bytes, std::uint32_t{3}, big_endian);
        for (const std::uint16_t index : std::array<std::uint16_t, 3>{2, 0, 1})
            put(bytes, index, big_endian);
        put(bytes, std::uint8_t{2}, big_endian);
        put(bytes, 0.5F, big_endian);
        put(bytes, 0.5F, big_endian);
        const Reading reading = read(bytes);
        EXPECT_EQ(reading.mesh.positions.at(2), glm::vec3(3, -4, -140000)) << big_endian;
        EXPECT_EQ(reading.mesh.triangles.at(0), (std::array<std::uint32_t, 3>{2, 0, 1}));
        EXPECT_TRUE(reading.warnings.empty());
    }
}

TEST(PlyReader, ReadsFacesBeforeVertices) {
    const Reading reading = read(header("ascii", "element face 1\n" + face_properties +
                                                     "element vertex 3\n" + position_properties) +
                                 "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
    EXPECT_EQ(reading.mesh.triangles.size(), 1U);
    EXPECT_EQ(reading.mesh.positions.size(), 3U);
}

TEST(PlyReader, ReadsNormalsTextureCoordinatesAndColours) {
    for (const char* names : {"u v", "s t", "texture_u texture_v"}) {
        const std::string text(names);
        const std::size_t gap = text.find(' ');
        const Reading reading = read(
            header("ascii", "element vertex 3\n" + position_properties +
                                "property float nx\nproperty float ny\nproperty float nz\n"
                                "property float " +
                                text.substr(0, gap) + "\nproperty float " + text.substr(gap + 1) +
                                "\nproperty uchar red\nproperty uchar green\n"
                                "property uchar blue\nelement face 1\n" +
                                face_properties) +
            "0 0 0 0 0 2 0 7 0 188 255\n1 0 0 0 3 4 1 0 0 0 0\n0 1 0 0 0 1 0 1 0 0 0\n"
            "3 0 1 2\n");
        const Mesh& mesh = reading.mesh;
        EXPECT_EQ(mesh.normals.at(0), glm::vec3(0, 0, 1)) << names;
        EXPECT_NEAR(glm::length(mesh.normals.at(1) - glm::vec3(0, 0.6F, 0.8F)), 0.0F, 1e-6F);
        EXPECT_EQ(mesh.uvs.at(0), glm::vec2(0, 7)) << names;
        // 188 of 255 in sRGB is half of the light.
        EXPECT_NEAR(mesh.colours.at(0).g, 0.5F, 0.005F);
        EXPECT_FLOAT_EQ(mesh.colours.at(0).b, 1.0F);
    }
}

TEST(PlyReader, TakesFloatColoursAsLinear) {
    const Reading reading =
        read(header("ascii", "element vertex 3\n" + position_properties +
                                 "property float red\nproperty float green\nproperty float blue\n"
                                 "element face 1\n" +
                                 face_properties) +
             "0 0 0 0.25 0.5 1\n1 0 0 0 0 0\n0 1 0 3 -1 nan\n3 0 1 2\n");
    EXPECT_EQ(reading.mesh.colours.at(0), glm::vec3(0.25F, 0.5F, 1.0F));
    EXPECT_EQ(reading.mesh.colours.at(2), glm::vec3(1.0F));
    ASSERT_EQ(reading.warnings.size(), 1U);
    EXPECT_NE(reading.warnings[0].find("1 vertex colour: outside of [0, 1], clamped; at "),
              std::string::npos);
}

TEST(PlyReader, CutsPolygonsIntoFansAndDropsLines) {
    const Reading reading =
        read(header("ascii", "element vertex 5\n" + position_properties + "element face 3\n" +
                                 face_properties) +
             "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 2 0\n5 0 1 2 3 4\n2 0 1\n4 4 3 2 1\n");
    const std::vector<std::array<std::uint32_t, 3>> expected = {
        {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {4, 3, 2}, {4, 2, 1}};
    EXPECT_EQ(reading.mesh.triangles, expected);
    ASSERT_EQ(reading.warnings.size(), 1U);
    EXPECT_NE(reading.warnings[0].find("1 face: fewer than three corners, left out; at "),
              std::string::npos);
}

TEST(PlyReader, DropsTrianglesWithNonFiniteVertices) {
    const Reading reading = read(header("ascii", "element vertex 6\n" + position_properties +
                                                     "element face 4\n" + face_properties) +
                                 "nan 0 0\n1 0 0\n0 1 0\n7 7 7\n0 inf 0\n0 0 1e300\n"
                                 "3 0 1 2\n3 1 2 3\n3 1 2 4\n3 5 1 2\n");
    EXPECT_EQ(reading.mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{1, 2, 3}}));
    for (const glm::vec3& position : reading.mesh.positions)
        EXPECT_LE(glm::length(position), 13.0F);
    ASSERT_EQ(reading.warnings.size(), 1U);
    EXPECT_NE(reading.warnings[0].find("3 triangles: a vertex is not finite, left out; at "),
              std::string::npos);
}

TEST(PlyReader, ReplacesUselessNormalsByGeometricOnes) {
    const Reading reading =
        read(header("ascii", "element vertex 3\n" + position_properties +
                                 "property float nx\nproperty float ny\nproperty float nz\n"
                                 "element face 1\n" +
                                 face_properties) +
             "0 0 0 0 0 0\n1 0 0 nan 0 1\n0 1 0 0 1 0\n3 0 1 2\n");
    EXPECT_EQ(reading.mesh.normals.at(0), glm::vec3(0, 0, 1));
    EXPECT_EQ(reading.mesh.normals.at(1), glm::vec3(0, 0, 1));
    EXPECT_EQ(reading.mesh.normals.at(2), glm::vec3(0, 1, 0));
    EXPECT_EQ(reading.warnings.size(), 1U);
}

TEST(PlyReader, AcceptsCarriageReturnsPlusSignsAndMissingFinalNewline) {
    const Reading reading = read(
        "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\n"
        "property float y\r\nproperty float z\r\nelement face 1\r\n"
        "property list uchar int vertex_indices\r\nend_header\r\n"
        "+1 0 0\r\n1 0 0\r\n0 1e0 0\r\n3 0 1 2");
    EXPECT_EQ(reading.mesh.positions.at(0), glm::vec3(1, 0, 0));
    EXPECT_EQ(reading.mesh.triangles.size(), 1U);
}

TEST(PlyReader, AcceptsEmptyMeshesAndNamesTrailingData) {
    EXPECT_TRUE(read(header("ascii", "element vertex 0\n" + position_properties +
                                         "element face 0\n" + face_properties))
                    .mesh.triangles.empty());
    const Reading reading = read(triangle_header() + triangle_body + "4 5 6");
    ASSERT_EQ(reading.warnings.size(), 1U);
    EXPECT_NE(reading.warnings[0].find("data after the last element"), std::string::npos);
}

TEST(PlyReader, NamesTheLineOfEveryHeaderFault) {
    const std::string start = "ply\nformat ascii 1.0\n";
    expect_error("", "m.ply:1: the file ends inside its header");
    expect_error("plyx\n", "m.ply:1: not a PLY file");
    expect_error("ply\nformat ascii 2.0\n", "m.ply:2: bad format line");
    expect_error("ply\nformat binary 1.0\n", "m.ply:2: unknown format 'binary'");
    expect_error("ply\nformat ascii 1.0\nformat ascii 1.0\n", "m.ply:3: bad format line");
    expect_error("ply\nend_header\n", "m.ply:2: the header ends without a format line");
    expect_error(start + "elephant vertex 3\n", "m.ply:3: unknown header line 'elephant'");
    expect_error(start + "property float x\n", "m.ply:3: a property before the first element");
    expect_error(start + "element vertex -3\n", "m.ply:3: bad number of elements '-3'");
    expect_error(start + "element vertex 99999999999999999999\n",
                 "m.ply:3: bad number of elements");
    expect_error(start + "element vertex 3\nelement vertex 3\n",
                 "m.ply:4: element 'vertex' is declared twice");
    expect_error(start + "element vertex 3\nproperty quad x\n", "m.ply:4: unknown type 'quad'");
    expect_error(start + "element vertex 3\nproperty float\n", "m.ply:4: bad property line");
    expect_error(start + "element vertex 3\nproperty float x\nproperty int x\n",
                 "m.ply:5: property 'x' is declared twice");
    expect_error(start + "element face 3\nproperty list float int vertex_indices\n",
                 "m.ply:4: list lengths of type 'float'");
    expect_error(start + std::string(5000, 'a'), "m.ply:3: header line too long");
}

TEST(PlyReader, RefusesHeadersThatDeclareTooMuch) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 1\n";
    for (int i = 0; i < 2000; ++i) text += "property float p" + std::to_string(i) + "\n";
    expect_error(text, "m.ply:1027: more than 1024 elements and properties");
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        expect_error(header(format, "element vertex 18446744073709551615\n" + position_properties +
                                        "element face 1\n" + face_properties),
                     "m.ply:3: 18446744073709551615 'vertex' elements do not fit");
        expect_error(header(format, "element vertex 0\n" + position_properties +
                                        "element face 4000000000\n" + face_properties),
                     "m.ply:7: 4000000000 'face' elements do not fit");
        expect_error(header(format, "element face 1\n" + face_properties) + "\x7F\x01",
                     format == std::string("ascii") ? "m.ply:6: bad value" : "m.ply: face 0: ");
    }
    // An element without properties takes no bytes, whatever its count.
    const Reading reading =
        read(header("ascii", "element nothing 18446744073709551615\nelement vertex 3\n" +
                                 position_properties + "element face 1\n" + face_properties) +
             triangle_body);
    EXPECT_EQ(reading.mesh.triangles.size(), 1U);
}

TEST(PlyReader, RefusesElementsOfTheWrongShape) {
    expect_error(header("ascii",
                        "element vertex 1\nproperty float x\nproperty float y\n"
                        "element face 0\n" +
                            face_properties) +
                     "1 2\n",
                 "m.ply:3: vertices without a position");
    expect_error(header("ascii", "element vertex 1\n" + position_properties) + "1 2 3\n",
                 "m.ply:7: no faces");
    expect_error(header("ascii", "element vertex 0\n" + position_properties +
                                     "element face 1\nproperty int vertex_indices\n") +
                     "1\n",
                 "m.ply:7: faces without corners");
    expect_error(header("ascii", "element vertex 0\n" + position_properties +
                                     "element face 1\nproperty list uchar float vertex_indices\n") +
                     "0\n",
                 "m.ply:7: faces without corners");
}

TEST(PlyReader, NamesTheLineOfEveryBodyFault) {
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
    expect_error(triangle_header() + vertices + "3 0 1 3\n",
                 "m.ply:13: vertex index 3, expected an integer from 0 to below 3");
    expect_error(triangle_header() + vertices + "3 0 1 -1\n", "m.ply:13: vertex index -1");
    expect_error(triangle_header() + vertices + "3 0 1 1.5\n", "m.ply:13: vertex index 1.5");
    expect_error(triangle_header() + vertices + "3 0 1 nan\n", "m.ply:13: vertex index nan");
    expect_error(triangle_header() + vertices + "300 0 1 2\n", "m.ply:13: list length 300");
    expect_error(triangle_header() + vertices + "-1 0 1 2\n", "m.ply:13: list length -1");
    expect_error(triangle_header() + vertices + "3 0 1   ", "m.ply:13: the file ends here");
    expect_error(triangle_header() + vertices + "3 0 11111", "m.ply:13: vertex index 11111");
    expect_error(triangle_header() + "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n", "m.ply:11: bad value");
    expect_error(triangle_header() + "0 0 0\n1 0x1 0\n0 1 0\n3 0 1 2\n", "m.ply:11: bad value");
}

TEST(PlyReader, NamesTheLineOfTheValueThatIsWrong) {
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
    expect_error(triangle_header() + vertices + "3 0\n\n 3\n\n1\n", "m.ply:15: vertex index 3");
    expect_error(triangle_header() + "0 0 0 1 0 0 0 1 0 3 0 3 1\n", "m.ply:10: vertex index 3");
    expect_error(triangle_header() + vertices + "3 0 1\n\n\n", "m.ply:13: the file ends here");
    expect_error(triangle_header(), "m.ply:3: 3 'vertex' elements do not fit");
}

TEST(PlyReader, NamesTheItemOfABinaryFileThatIsWrong) {
    for (const bool big_endian : {false, true}) {
        std::string bytes = header(
            big_endian ? "binary_big_endian" : "binary_little_endian",
            "element vertex 1\n" + position_properties + "element face 2\n" + face_properties);
        for (const float value : {0.F, 0.F, 0.F}) put(bytes, value, big_endian);
        for (const std::int32_t last : {0, 1}) {
            put(bytes, std::uint8_t{3}, big_endian);
            for (const std::int32_t index : {0, 0, last}) put(bytes, index, big_endian);
        }
        expect_error(bytes, "m.ply: face 1: vertex index 1, expected an integer");
        bytes.resize(bytes.size() - 2);
        expect_error(bytes, "m.ply: face 1: list length 3 of 'vertex_indices'");
    }
}

TEST(PlyReader, RefusesEveryTruncationOfABinaryFile) {
    std::string bytes = triangle_header("binary_little_endian");
    const std::size_t body = bytes.size();
    for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F})
        put(bytes, value, false);
    put(bytes, std::uint8_t{3}, false);
    for (const std::int32_t index : {0, 1, 2}) put(bytes, index, false);
    EXPECT_EQ(read(bytes).mesh.triangles.size(), 1U);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        const std::string place = length < body ? "m.ply:" : "m.ply";
        expect_error(bytes.substr(0, length), place);
    }
}

TEST(PlyReader, NamesTheReferenceOfAMissingFile) {
    Diagnostics diagnostics;
    try {
        (void)read_ply("no-such-folder/none.ply", "scene.xml:7", diagnostics);
        FAIL() << "read a file that does not exist";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).rfind("scene.xml:7: ", 0), 0U) << error.what();
    }
}

TEST(PlyReader, ReadsLargeFilesInLinearTime) {
    constexpr std::uint32_t side = 400;
    std::string bytes = header(
        "binary_little_endian",
        "element vertex " + std::to_string(side * side) + "\n" + position_properties +
            "element face " + std::to_string((side - 1) * (side - 1)) + "\n" + face_properties);
    for (std::uint32_t i = 0; i < side * side; ++i) {
        for (const std::uint32_t value : {i % side, i / side, 0U})
            put(bytes, static_cast<float>(value), false);
    }
    for (std::uint32_t row = 0; row + 1 < side; ++row) {
        for (std::uint32_t column = 0; column + 1 < side; ++column) {
            put(bytes, std::uint8_t{4}, false);
            const std::uint32_t first = row * side + column;
            for (const std::uint32_t index : {first, first + 1, first + side + 1, first + side})
                put(bytes, index, false);
        }
    }
    const auto start = std::chrono::steady_clock::now();
    const Reading reading = read(bytes);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(reading.mesh.triangles.size(), 2U * (side - 1) * (side - 1));
    // Tens of milliseconds in truth; the bound leaves room for sanitizers and busy machines.
    EXPECT_LT(seconds.count(), 10.0);
}

}  // namespace
}  // namespace weft::ply_reader_test
