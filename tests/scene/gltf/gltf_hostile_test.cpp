// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "base/limits.h"
#include "tests/testing/gltf_builder.h"

namespace weft::gltf_hostile_test {
namespace {

using Json = nlohmann::json;

/// The error after one value of a good file is replaced.
std::string error_after(const char* pointer, const Json& value) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.add_accessor<std::uint16_t>({0, 1, 2}, 5123, "SCALAR", 3);
    builder.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    builder.primitive()["indices"] = 1;
    builder.primitive()["attributes"]["NORMAL"] = 2;
    builder.json["buffers"] = {{{"byteLength", builder.binary.size()},
                                {"uri", "data:;base64," + encode_base64(builder.binary)}}};
    EXPECT_EQ(builder.error(), "no error");
    builder.json[Json::json_pointer(pointer)] = value;
    return builder.error();
}

/// The error after the nodes of a good file are replaced.
std::string error_of_nodes(const Json& nodes, const Json& roots = {0}) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["nodes"] = nodes;
    builder.json["scenes"][0]["nodes"] = roots;
    return builder.error();
}

std::string words(const std::vector<std::uint32_t>& values) {
    std::string bytes(values.size() * 4, '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

std::string glb_error(const std::string& content) {
    return GltfBuilder::error_of("a.glb", content);
}

TEST(GltfHostile, NamesLineAndColumnOfBrokenJson) {
    EXPECT_EQ(GltfBuilder::error_of("a.gltf", "{\n \"asset\": {,}\n}"),
              ":2: JSON syntax error at column 12");
    EXPECT_EQ(GltfBuilder::error_of("a.gltf", ""), ":1: JSON syntax error at column 1");
    EXPECT_EQ(GltfBuilder::error_of("a.gltf", "{} x"), ":1: JSON syntax error at column 4");
    EXPECT_EQ(GltfBuilder::error_of("a.gltf", "{\n\"a\":\n1e999}"),
              ":3: the number '1e999' is too large, expected at most 1.8e308");
    EXPECT_NE(GltfBuilder::error_of("a.gltf", "{\"asset\": \"\xff\"}"), "no error");
}

TEST(GltfHostile, RefusesDeepNestingBeforeParsing) {
    const std::string deep(10'000'000, '[');
    EXPECT_EQ(GltfBuilder::error_of("a.gltf", deep), ":1: JSON is nested deeper than 128 levels");
    EXPECT_EQ(GltfBuilder::error_of("a.gltf", "{\"[[\\\"[[\":\n" + std::string(127, '[') + "{"),
              ":2: JSON is nested deeper than 128 levels");
    // Brackets inside strings do not count.
    EXPECT_EQ(GltfBuilder::error_of("a.gltf", "{\"" + std::string(500, '[') + "\": 1}"),
              "#: lacks 'asset', which is required");
}

TEST(GltfHostile, RefusesEndlessArraysBeforeParsing) {
    std::string text = "[";
    for (std::size_t i = 0; i < limits::max_json_values; ++i) text += "0,";
    EXPECT_EQ(GltfBuilder::error_of("a.gltf", text), ":1: JSON holds more than 16777216 values");
}

TEST(GltfHostile, ChecksTheVersion) {
    EXPECT_EQ(GltfBuilder::error_of("a.gltf", "[]"), "#: is of type array, expected an object");
    EXPECT_EQ(error_after("/asset/version", "1.0"),
              "#/asset/version: glTF version '1.0', expected 2.0");
    EXPECT_EQ(error_after("/asset/version", 2),
              "#/asset/version: is of type number, expected a string");
    EXPECT_EQ(error_after("/asset/minVersion", "2.1"),
              "#/asset/minVersion: needs glTF version '2.1' or later, expected 2.0");
}

TEST(GltfHostile, ChecksTheChunksOfBinaryFiles) {
    const std::string json = "{\"asset\":{\"version\":\"2.0\"}} ";
    const auto size = static_cast<std::uint32_t>(json.size());
    const std::uint32_t magic = 0x46546C67;
    const std::uint32_t type = 0x4E4F534A;
    EXPECT_EQ(glb_error(words({magic, 2, size + 20, size, type}) + json), "no error");
    EXPECT_EQ(glb_error(json), ": does not start with 'glTF', expected binary glTF");
    EXPECT_EQ(glb_error("glTF\2"), ": binary glTF is shorter than its 12 byte header");
    EXPECT_EQ(glb_error(words({magic, 1, 12})),
              ": binary glTF has container version 1, expected 2");
    EXPECT_EQ(glb_error(words({magic, 2, 0xFFFFFFFF})),
              ": binary glTF states a length of 4294967295 bytes, but the file has 12");
    EXPECT_EQ(glb_error(words({magic, 2, 12})), ": binary glTF holds no JSON chunk");
    EXPECT_EQ(glb_error(words({magic, 2, 16, 0})),
              ": binary glTF ends inside the header of chunk 0");
    EXPECT_EQ(glb_error(words({magic, 2, size + 20, 0xFFFFFFFF, type}) + json),
              ": binary glTF chunk 0 of 4294967295 bytes does not fit into the " +
                  std::to_string(size) + " bytes left");
    EXPECT_EQ(glb_error(words({magic, 2, size + 20, size, 0x004E4942}) + json),
              ": binary glTF expected one JSON chunk, as the first");
}

TEST(GltfHostile, ChecksBuffers) {
    EXPECT_EQ(error_after("/buffers/0/byteLength", 5000),
              "#/buffers/0/byteLength: is 5000, but the buffer has only 80 bytes");
    EXPECT_EQ(error_after("/buffers/0/byteLength", 1e15),
              "#/buffers/0/byteLength: all buffers together are longer than the limit of "
              "4294967296 bytes");
    EXPECT_EQ(error_after("/buffers/0/byteLength", -1),
              "#/buffers/0/byteLength: is -1, expected a whole number that is not negative");
    EXPECT_EQ(error_after("/buffers/0", {{"byteLength", 8}}),
              "#/buffers/0: lacks 'uri', and there is no binary chunk that could stand for it");
    EXPECT_EQ(error_after("/buffers/0/uri", "data:,abc"),
              "#/buffers/0/uri: data URI is not base64 encoded, expected 'data:...;base64,...'");
    EXPECT_EQ(error_after("/buffers/0/uri", "data:;base64,AB*D"),
              "#/buffers/0/uri: base64 data holds an invalid character at position 2");
    EXPECT_EQ(error_after("/buffers/0/uri", "data:;base64,ABCDE"),
              "#/buffers/0/uri: base64 data has an impossible length of 5 characters");
    EXPECT_NE(error_after("/buffers/0/uri", "data:;base64,AA==AAAA").find("invalid character"),
              std::string::npos);
    for (const char* hostile : {"../a.bin", "/etc/passwd", "http://a/b", "file:///etc/passwd",
                                "%2e%2e/a.bin", "a%00.bin"})
        EXPECT_EQ(error_after("/buffers/0/uri", hostile).rfind("#/buffers/0/uri: reference '", 0),
                  0U)
            << hostile;
    EXPECT_EQ(error_after("/buffers/0/uri", "none.bin").rfind("#/buffers/0/uri: file '", 0), 0U);
}

TEST(GltfHostile, ChecksBufferViews) {
    EXPECT_EQ(error_after("/bufferViews/0/buffer", 1),
              "#/bufferViews/0/buffer: is 1, but there are only 1 buffers");
    EXPECT_EQ(error_after("/bufferViews/0/byteOffset", 60),
              "#/bufferViews/0: covers bytes 60 to 96, but the buffer has only 80");
    EXPECT_EQ(error_after("/bufferViews/0/byteLength", 9007199254740992.0),
              "#/bufferViews/0: covers bytes 0 to 9007199254740992, but the buffer has only 80");
    EXPECT_EQ(error_after("/bufferViews/0/byteLength", 1e17),
              "#/bufferViews/0/byteLength: is 1e+17, expected a whole number that is not "
              "negative");
    EXPECT_EQ(error_after("/bufferViews/0/byteStride", 256),
              "#/bufferViews/0/byteStride: is 256, expected 4 to 252");
    EXPECT_EQ(error_after("/bufferViews/0/byteStride", 8),
              "#/accessors/0: has elements of 12 bytes, but its bufferView has a byteStride of 8");
}

TEST(GltfHostile, ChecksAccessors) {
    EXPECT_EQ(error_after("/accessors/0/count", 4),
              "#/accessors/0: needs 48 bytes from byte 0, but the bufferView has only 36");
    EXPECT_EQ(error_after("/accessors/0/count", 4294967296),
              "#/accessors/0/count: is 4294967296, expected 1 to 268435456");
    EXPECT_EQ(error_after("/accessors/0/count", 0),
              "#/accessors/0/count: is 0, expected 1 to 268435456");
    EXPECT_EQ(error_after("/accessors/0",
                          {{"componentType", 5126}, {"type", "VEC3"}, {"count", 200000000}}),
              "#/accessors/0/count: is 200000000, expected 1 to 16777216");
    EXPECT_EQ(error_after("/accessors/0/byteOffset", 9007199254740992.0),
              "#/accessors/0: needs 36 bytes from byte 9007199254740992, but the bufferView has "
              "only 36");
    EXPECT_EQ(error_after("/accessors/0/componentType", 5124),
              "#/accessors/0/componentType: is 5124, expected 5120, 5121, 5122, 5123, 5125 or "
              "5126");
    EXPECT_EQ(error_after("/accessors/0/type", "MAT3"),
              "#/accessors/0/type: is 'MAT3', expected SCALAR, VEC2, VEC3, VEC4 or MAT4");
    EXPECT_EQ(error_after("/accessors/0/bufferView", 3),
              "#/accessors/0/bufferView: is 3, but there are only 3 bufferViews");
}

TEST(GltfHostile, ChecksSparseAccessors) {
    const auto error_of_indices = [](const std::vector<std::uint16_t>& indices, int type,
                                     std::size_t count) {
        GltfBuilder builder = GltfBuilder::triangle();
        const std::size_t view = builder.add_view(indices);
        builder.json["accessors"][0]["sparse"] = {
            {"count", count},
            {"indices", {{"bufferView", view}, {"componentType", type}}},
            {"values", {{"bufferView", 0}}}};
        return builder.error();
    };
    EXPECT_EQ(error_of_indices({0, 2}, 5123, 2), "no error");
    EXPECT_EQ(error_of_indices({0, 3}, 5123, 2),
              "#/accessors/0/sparse/indices: index 3 of element 1 is out of range, expected below "
              "3");
    EXPECT_EQ(error_of_indices({1, 1}, 5123, 2),
              "#/accessors/0/sparse/indices: element 1 does not increase, expected strictly "
              "increasing indices");
    EXPECT_EQ(error_of_indices({0, 1}, 5123, 4),
              "#/accessors/0/sparse/count: is 4, expected 1 to 3");
    EXPECT_EQ(error_of_indices({0, 1}, 5123, 3),
              "#/accessors/0/sparse/indices: needs 6 bytes from byte 0, but the bufferView has "
              "only 4");
    EXPECT_EQ(error_of_indices({0, 1}, 5122, 2),
              "#/accessors/0/sparse/indices/componentType: is not an unsigned integer, expected "
              "5121, 5123 or 5125");
}

TEST(GltfHostile, ChecksPrimitives) {
    const std::string at = "#/meshes/0/primitives/0";
    const auto pointer = [](const char* rest) {
        return std::string("/meshes/0/primitives/0") + rest;
    };
    EXPECT_EQ(error_after(pointer("/indices").c_str(), 0),
              at + "/indices: is not an accessor of SCALAR unsigned integers");
    EXPECT_EQ(error_after(pointer("/indices").c_str(), 3),
              at + "/indices: is 3, but there are only 3 accessors");
    EXPECT_EQ(error_after(pointer("/attributes/POSITION").c_str(), 1),
              at + "/attributes/POSITION: has 1 components, expected 3");
    EXPECT_EQ(error_after("/accessors/2/count", 2),
              at + "/attributes/NORMAL: has 2 elements, expected as many as POSITION, 3");
    EXPECT_EQ(error_after("/accessors/1/count", 2),
              at + ": has 2 vertices to draw, expected a multiple of 3");
    EXPECT_EQ(error_after(pointer("/mode").c_str(), 7), at + "/mode: is 7, expected 0 to 6");
    EXPECT_EQ(error_after(pointer("/material").c_str(), 0),
              at + "/material: is 0, but there are only 0 materials");
    EXPECT_EQ(error_after("/accessors/1/byteOffset", 2).rfind("#/accessors/1: needs 6 bytes", 0),
              0U);
    EXPECT_EQ(error_after("/accessors/0/count", 2),
              at + "/indices: index 2 of element 2 is out of range, expected below 2");
}

TEST(GltfHostile, RefusesCyclesAndSharedNodes) {
    EXPECT_EQ(error_of_nodes({{{"children", {0}}}}),
              "#/nodes/0/children/0: node 0 is its own child, expected no cycles");
    EXPECT_EQ(error_of_nodes({Json::object(), {{"children", {2}}}, {{"children", {1}}}}),
              "#/nodes/1: node is its own ancestor, expected no cycles");
    EXPECT_EQ(error_of_nodes({{{"children", {1, 1}}}, Json::object()}),
              "#/nodes/0/children/1: node 1 is already a child of node 0, expected one parent");
    EXPECT_EQ(error_of_nodes({{{"children", {1}}}, Json::object()}, {1}),
              "#/scenes/0/nodes/0: node 1 is a child of node 0, expected a root node");
    EXPECT_EQ(error_of_nodes(Json::array({Json::object()}), {0, 0}),
              "#/scenes/0/nodes/1: node 0 is listed twice");
    EXPECT_EQ(error_of_nodes({{{"children", {9}}}}),
              "#/nodes/0/children/0: is 9, but there are only 1 nodes");
    EXPECT_EQ(error_of_nodes(Json::array({Json::object()}), Json::array({4})),
              "#/scenes/0/nodes/0: is 4, but there are only 1 nodes");
    EXPECT_EQ(error_after("/scene", 1), "#/scene: is 1, but there are only 1 scenes");
}

TEST(GltfHostile, LimitsTheDepthOfTheHierarchy) {
    Json chain = Json::array();
    for (int i = 0; i < 128; ++i) chain.push_back({{"children", {i + 1}}});
    chain.push_back(Json::object());
    EXPECT_EQ(error_of_nodes(chain), "#/nodes/128: node is nested deeper than 128 levels");
    chain.erase(128);
    chain[127] = Json::object();
    EXPECT_EQ(error_of_nodes(chain), "no error");
}

TEST(GltfHostile, ChecksTransforms) {
    EXPECT_EQ(error_of_nodes({{{"scale", {1e300, 1, 1}}, {"children", {1}}},
                              {{"scale", {1e300, 1, 1}}, {"mesh", 0}}}),
              "#/nodes/1: the transform to world space is not finite");
    EXPECT_EQ(error_of_nodes({{{"rotation", {0, 0, 0, 0}}}}),
              "#/nodes/0/rotation: is a quaternion of length 0.000000, expected 1");
    EXPECT_EQ(error_of_nodes({{{"matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}),
              "#/nodes/0/matrix: is not affine, expected 0, 0, 0, 1 as its last row");
    EXPECT_EQ(error_of_nodes({{{"translation", {1, 2}}}}),
              "#/nodes/0/translation: has 2 elements, expected 3");
    EXPECT_EQ(error_of_nodes({{{"translation", {1, "2", 3}}}}),
              "#/nodes/0/translation/1: is of type string, expected a number");
    EXPECT_EQ(error_of_nodes({{{"mesh", 0}, {"name", "far"}, {"translation", {2e15, 0, 0}}}}),
              ": instance 'far' lies too far from the origin");
    EXPECT_EQ(error_of_nodes({{{"mesh", 1}}}), "#/nodes/0/mesh: is 1, but there are only 1 meshes");
}

TEST(GltfHostile, ChecksLightsAndCameras) {
    const auto error_of_light = [](const Json& light) {
        GltfBuilder builder = GltfBuilder::triangle();
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
        builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
        return builder.error();
    };
    const std::string at = "#/extensions/KHR_lights_punctual/lights/0";
    const auto spot = [](double inner, double outer) {
        return Json{{"type", "spot"},
                    {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}};
    };
    EXPECT_EQ(error_of_light(spot(0, 1.5707964)), "no error");
    EXPECT_EQ(error_of_light(spot(0.5, 0.5)),
              at + "/spot: innerConeAngle is 0.500000, expected at least 0 and below "
                   "outerConeAngle, 0.500000");
    EXPECT_EQ(error_of_light(spot(0, 1.7)),
              at + "/spot: outerConeAngle is 1.700000, expected above 0 and at most pi/2");
    EXPECT_EQ(error_of_light({{"type", "spot"}}), at + ": lacks 'spot', which is required");
    EXPECT_EQ(error_of_light({{"type", "laser"}}),
              at + "/type: is 'laser', expected point, spot or directional");
    EXPECT_EQ(error_of_light({{"type", "point"}, {"intensity", -1}}),
              at + "/intensity: is -1.000000, expected 0 to 1e30");

    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 3.2}}}}};
    builder.json["nodes"][0]["camera"] = 0;
    EXPECT_EQ(builder.error(),
              "#/cameras/0/perspective/yfov: is 3.200000, expected an angle above "
              "0 and below pi");
}

TEST(GltfHostile, RefusesRequiredExtensionsItDoesNotKnow) {
    EXPECT_EQ(error_after("/extensionsRequired", {"KHR_draco_mesh_compression"}),
              "#/extensionsRequired/0: the file requires the extension "
              "'KHR_draco_mesh_compression', which is not supported");
}

TEST(GltfHostile, EveryCutOfAFileIsRefused) {
    const std::string text = GltfBuilder::triangle().text();
    for (std::size_t length = 0; length < text.size(); ++length)
        EXPECT_NE(GltfBuilder::error_of("a.gltf", text.substr(0, length)), "no error") << length;
}

TEST(GltfHostile, EveryValueOfAnotherTypeIsReadOrRefused) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["buffers"] = {{{"byteLength", builder.binary.size()},
                                {"uri", "data:;base64," + encode_base64(builder.binary)}}};
    const Json flat = builder.json.flatten();
    const std::vector<Json> values = {nullptr,       true,           -1,         1e308, 3.5, "text",
                                      Json::array(), Json::object(), 4294967295U};
    for (const auto& [pointer, original] : flat.items()) {
        for (Json::json_pointer place(pointer); !place.empty(); place = place.parent_pointer()) {
            for (const Json& value : values) {
                GltfBuilder changed = builder;
                changed.json[place] = value;
                EXPECT_NE(changed.error(), "wrong exit code") << place << " = " << value;
            }
        }
    }
}

TEST(GltfHostile, CutsEndlessNamesBetweenCharacters) {
    GltfBuilder builder = GltfBuilder::triangle();
    std::string name = "x";
    while (name.size() < 100'000) name += "\u00e9";  // two bytes
    builder.json["meshes"][0]["name"] = name;
    const Scene scene = builder.read();
    EXPECT_EQ(scene.instances.at(0).name, name.substr(0, 255));
    EXPECT_EQ(scene.meshes.at(0).name, name.substr(0, 255));
}

TEST(GltfHostile, FloodsOfWarningsEnd) {
    GltfBuilder builder = GltfBuilder::triangle();
    for (int i = 0; i < 5000; ++i)
        builder.json["extensionsUsed"].push_back("EXT_" + std::to_string(i));
    builder.read();
    EXPECT_EQ(builder.diagnostics.warnings().size(), limits::max_warnings + 1);
    EXPECT_TRUE(builder.warned("further kinds of warnings are left out"));
}

}  // namespace
}  // namespace weft::gltf_hostile_test
