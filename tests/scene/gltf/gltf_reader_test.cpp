// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "tests/testing/gltf_builder.h"

namespace weft::gltf_reader_test {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Json = nlohmann::json;

std::string words(const std::vector<std::uint32_t>& values) {
    std::string bytes(values.size() * 4, '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

std::string make_glb(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    const auto size = [](const std::string& s) { return static_cast<std::uint32_t>(s.size()); };
    return words({0x46546C67, 2, 28 + size(json) + size(binary), size(json), 0x4E4F534A}) + json +
           words({size(binary), 0x004E4942}) + binary;
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-6) << "component " << i;
}

TEST(GltfReader, ReadsATriangle) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["nodes"][0]["name"] = "a node";
    builder.json["meshes"][0]["name"] = "a mesh";
    const Scene scene = builder.read();
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.meshes[0].name, "a mesh");
    EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.meshes[0].triangles, (std::vector<Triangle>{{0, 1, 2}}));
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    ASSERT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.instances[0].name, "a node");
    EXPECT_FALSE(scene.instances[0].flip_normals);
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(diffuse_albedo(scene.materials[0]), glm::vec3(1.0F));
    EXPECT_TRUE(scene.materials[0].two_sided);
    EXPECT_TRUE(builder.diagnostics.warnings().empty());
}

TEST(GltfReader, ReadsBinaryFilesAndBuffersBesideTheFile) {
    GltfBuilder builder = GltfBuilder::triangle();
    const TemporaryFolder folder;
    Diagnostics diagnostics;
    builder.json["buffers"] = {{{"byteLength", builder.binary.size()}}};
    const auto glb = folder.write("a.GLB", make_glb(builder.text(), builder.binary));
    EXPECT_EQ(read_gltf(glb, diagnostics).meshes.at(0).triangles.size(), 1U);

    builder.json["buffers"][0]["uri"] = "a%20buffer.bin";
    folder.write("a buffer.bin", builder.binary);
    const auto gltf = folder.write("a.gltf", builder.text());
    EXPECT_EQ(read_gltf(gltf, diagnostics).meshes.at(0).triangles.size(), 1U);
}

TEST(GltfReader, ReadsEveryIndexType) {
    for (const int type : {5121, 5123, 5125}) {
        GltfBuilder builder = GltfBuilder::triangle();
        if (type == 5121) builder.add_accessor<std::uint8_t>({2, 0, 1}, type, "SCALAR", 3);
        if (type == 5123) builder.add_accessor<std::uint16_t>({2, 0, 1}, type, "SCALAR", 3);
        if (type == 5125) builder.add_accessor<std::uint32_t>({2, 0, 1}, type, "SCALAR", 3);
        builder.primitive()["indices"] = 1;
        EXPECT_EQ(builder.read().meshes.at(0).triangles, (std::vector<Triangle>{{2, 0, 1}}))
            << type;
    }
}

TEST(GltfReader, ReadsStripsAndFans) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0}, "VEC3", 3);
    builder.primitive()["attributes"]["POSITION"] = 1;
    builder.primitive()["mode"] = 5;
    EXPECT_EQ(builder.read().meshes.at(0).triangles,
              (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
    builder.primitive()["mode"] = 6;
    EXPECT_EQ(builder.read().meshes.at(0).triangles,
              (std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(GltfReader, DropsDegenerateTrianglesOfStrips) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.add_accessor<std::uint8_t>({0, 1, 2, 2, 1, 0}, 5121, "SCALAR", 6);
    builder.primitive()["indices"] = 1;
    builder.primitive()["mode"] = 5;
    EXPECT_EQ(builder.read().meshes.at(0).triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 0, 1}}));
}

TEST(GltfReader, LeavesOutPointsAndLinesWithOneWarning) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.primitive()["mode"] = 0;
    builder.json["meshes"][0]["primitives"].push_back(builder.primitive());
    const Scene scene = builder.read();
    EXPECT_TRUE(scene.instances.empty());
    ASSERT_EQ(builder.diagnostics.warnings().size(), 1U);
    EXPECT_TRUE(builder.warned(
        "2 primitives: points and lines are not simulated, they are left out; first: "));
}

TEST(GltfReader, KeepsOnlyTheVerticesThatTrianglesUse) {
    GltfBuilder builder = GltfBuilder::triangle();
    std::vector<float> positions(30000, 0.0F);
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<float>(i);
    builder.add_floats(positions, "VEC3", 3);
    builder.add_accessor<std::uint32_t>({9999, 5, 17}, 5125, "SCALAR", 3);
    builder.primitive()["attributes"]["POSITION"] = 1;
    builder.primitive()["indices"] = 2;
    for (const bool sparse_use : {true, false}) {
        const Scene scene = builder.read();
        const Mesh& mesh = scene.meshes.at(0);
        if (sparse_use) {
            EXPECT_EQ(mesh.positions.size(), 3U);
        }
        EXPECT_EQ(mesh.positions[mesh.triangles[0][0]], glm::vec3(29997, 29998, 29999));
        EXPECT_EQ(mesh.positions[mesh.triangles[0][1]], glm::vec3(15, 16, 17));
        EXPECT_EQ(mesh.positions[mesh.triangles[0][2]], glm::vec3(51, 52, 53));
        // With many triangles the vertices are found through a table instead.
        std::vector<std::uint32_t> many = {9999, 5, 17};
        for (std::uint32_t i = 0; i + 2 < 9000; ++i) many.insert(many.end(), {i, i + 1, i + 2});
        builder.add_accessor(many, 5125, "SCALAR", many.size());
        builder.primitive()["indices"] = 3;
    }
}

TEST(GltfReader, ReadsInterleavedAndQuantizedAttributes) {
    GltfBuilder builder = GltfBuilder::triangle();
    // Three vertices of: 3 x int16 position, 2 bytes of padding, 4 x uint8 colour.
    std::vector<std::uint16_t> data;
    for (const unsigned x : {0U, 32767U, 0x8000U}) {
        data.insert(data.end(), {static_cast<std::uint16_t>(x), 1, 2, 0});
        data.insert(data.end(), {std::uint16_t{0xFF00}, std::uint16_t{0x0033}});
    }
    const std::size_t view = builder.add_view(data);
    builder.json["bufferViews"][view]["byteStride"] = 12;
    builder.json["accessors"].push_back({{"bufferView", view},
                                         {"componentType", 5122},
                                         {"normalized", true},
                                         {"type", "VEC3"},
                                         {"count", 3}});
    builder.json["accessors"].push_back({{"bufferView", view},
                                         {"byteOffset", 8},
                                         {"componentType", 5121},
                                         {"normalized", true},
                                         {"type", "VEC4"},
                                         {"count", 3}});
    builder.primitive()["attributes"] = {{"POSITION", 1}, {"COLOR_0", 2}};
    const Scene scene = builder.read();
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positions[1].x, 1.0F);
    EXPECT_EQ(mesh.positions[2].x, -1.0F);
    EXPECT_FLOAT_EQ(mesh.positions[2].z, 2.0F / 32767.0F);
    expect_near(mesh.colours[2], {0.0, 1.0, 0.2});
}

TEST(GltfReader, ReadsIntegersThatAreNotNormalized) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.add_accessor<std::int8_t>({0, 0, -128, 0, 1, 0, 0, 0, 0, 127, 0, 0}, 5120, "VEC3", 3);
    builder.json["bufferViews"][1]["byteStride"] = 4;
    builder.primitive()["attributes"]["POSITION"] = 1;
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes.at(0).positions[0].z, -128.0F);
    EXPECT_EQ(scene.meshes.at(0).positions[1], glm::vec3(1, 0, 0));
}

TEST(GltfReader, ReadsSparseAccessorsWithAndWithoutAView) {
    GltfBuilder builder = GltfBuilder::triangle();
    const std::size_t indices = builder.add_view<std::uint16_t>({1, 2});
    const std::size_t values = builder.add_view<float>({7, 8, 9, 4, 5, 6});
    const Json sparse = {{"count", 2},
                         {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                         {"values", {{"bufferView", values}}}};
    builder.json["accessors"][0]["sparse"] = sparse;
    EXPECT_EQ(builder.read().meshes.at(0).positions[1], glm::vec3(7, 8, 9));
    builder.json["accessors"][0].erase("bufferView");
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes.at(0).positions[0], glm::vec3(0, 0, 0));
    EXPECT_EQ(scene.meshes.at(0).positions[2], glm::vec3(4, 5, 6));
}

TEST(GltfReader, ComposesTheNodeHierarchy) {
    GltfBuilder builder = GltfBuilder::triangle();
    const double half = std::sqrt(0.5);
    builder.json["nodes"] = {
        {{"translation", {1, 2, 3}}, {"children", {1}}},
        {{"rotation", {0, 0, half, half}}, {"scale", {2, 3, 4}}, {"mesh", 0}, {"children", {2}}},
        {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}, {"mesh", 0}}};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.meshes.size(), 1U);  // shared
    const auto place = [&](std::size_t i, const glm::dvec4& p) {
        return glm::dvec3(scene.instances[i].to_world * p);
    };
    expect_near(place(0, {1, 0, 0, 1}), {1, 4, 3});  // x turns to y, twice as long
    expect_near(place(0, {0, 1, 1, 1}), {-2, 2, 7});
    expect_near(place(1, {0, 0, 0, 1}), {1, 22, 3});
}

TEST(GltfReader, KeepsLargeTranslationsExact) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["nodes"][0]["translation"] = {123456789.125, 0, 0};
    EXPECT_EQ(builder.read().instances.at(0).to_world[3][0], 123456789.125);
}

TEST(GltfReader, ChoosesTheScene) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["nodes"] = {{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"name", "b"}}};
    builder.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    builder.json["scene"] = 1;
    EXPECT_EQ(builder.read().instances.at(0).name, "b");
    builder.json.erase("scene");
    EXPECT_EQ(builder.read().instances.at(0).name, "a");
    EXPECT_TRUE(builder.warned("no default scene"));
    builder.json.erase("scenes");
    EXPECT_EQ(builder.read().instances.size(), 2U);
    EXPECT_TRUE(builder.warned("holds no scenes"));
}

TEST(GltfReader, DropsTrianglesOfNonFiniteVerticesAndCountsThem) {
    GltfBuilder builder = GltfBuilder::triangle();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    builder.add_floats(
        {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, nan, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, -inf, 0, 0, 1, 0},
        "VEC3", 3);
    builder.primitive()["attributes"]["POSITION"] = 1;
    EXPECT_EQ(builder.read().meshes.at(0).positions.size(), 3U);
    EXPECT_TRUE(builder.warned("2 triangles: a vertex is not finite, left out; at "));
}

TEST(GltfReader, RepairsNormals) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    for (const glm::vec3 broken : {glm::vec3(nan, 0, 0), glm::vec3(0, nan, 1), glm::vec3(1, 1, nan),
                                   glm::vec3(1, -inf, 1)}) {
        GltfBuilder builder = GltfBuilder::triangle();
        builder.add_floats({0, 0, -5, 0, 0, 0, broken.x, broken.y, broken.z}, "VEC3", 3);
        builder.primitive()["attributes"]["NORMAL"] = 1;
        const Scene scene = builder.read();
        EXPECT_EQ(scene.meshes.at(0).normals[0], glm::vec3(0, 0, -1));
        EXPECT_EQ(scene.meshes.at(0).normals[1], glm::vec3(0, 0, 1));
        EXPECT_EQ(scene.meshes.at(0).normals[2], glm::vec3(0, 0, 1));
        EXPECT_TRUE(
            builder.warned("2 normals: zero or not finite, the normals of the faces around are "
                           "used instead; at "));
    }
}

TEST(GltfReader, LeavesOutObjectsOfScaleZero) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["nodes"][0]["scale"] = {1, 0, 1};
    EXPECT_TRUE(builder.read().instances.empty());
    EXPECT_TRUE(builder.warned_at(
        "#/nodes/0", "the transform is singular (a scale of zero), the object is left out"));
    builder.json["nodes"][0]["scale"] = {1e-9, 1e-9, -1e-9};
    EXPECT_EQ(builder.read().instances.size(), 1U);
}

TEST(GltfReader, ReadsCameras) {
    GltfBuilder builder = GltfBuilder::triangle();
    const Json perspective = {{"type", "perspective"},
                              {"name", "lens"},
                              {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}};
    const Json orthographic = {
        {"type", "orthographic"},
        {"orthographic", {{"xmag", 2.0}, {"ymag", -0.5}, {"znear", 0.25}, {"zfar", 9.0}}}};
    builder.json["cameras"] = {orthographic, perspective};
    builder.json["nodes"] = {{{"camera", 1}, {"translation", {0, 0, 5}}, {"children", {1}}},
                             {{"camera", 0}},
                             {{"camera", 1}, {"name", "second"}}};
    builder.json["scenes"][0]["nodes"] = {0, 2};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.cameras.size(), 3U);
    EXPECT_EQ(scene.cameras[0].name, "lens");
    EXPECT_FALSE(scene.cameras[0].orthographic());
    EXPECT_EQ(scene.cameras[0].fov, 0.7);
    EXPECT_EQ(scene.cameras[0].fov_axis, FovAxis::y);
    EXPECT_EQ(scene.cameras[0].to_world[3][2], 5.0);
    EXPECT_TRUE(scene.cameras[1].orthographic());
    EXPECT_EQ(scene.cameras[1].half_extent, glm::dvec2(2.0, 0.5));
    EXPECT_EQ(scene.cameras[1].near_plane, 0.25);
    EXPECT_EQ(scene.cameras[1].to_world[3][2], 5.0);
    EXPECT_EQ(scene.cameras[2].name, "second");
}

TEST(GltfReader, RefusesOrthographicCamerasWithoutExtent) {
    const auto error = [](const Json& orthographic) {
        GltfBuilder builder = GltfBuilder::triangle();
        builder.json["cameras"] = {{{"type", "orthographic"}, {"orthographic", orthographic}}};
        builder.json["nodes"].push_back({{"camera", 0}});
        builder.json["scenes"][0]["nodes"].push_back(builder.json["nodes"].size() - 1);
        return builder.error();
    };
    EXPECT_NE(error({{"xmag", 0.0}, {"ymag", 1.0}, {"znear", 0.0}, {"zfar", 1.0}}).find("xmag"),
              std::string::npos);
    EXPECT_NE(error({{"xmag", 1.0}, {"znear", 0.0}, {"zfar", 1.0}}).find("ymag"),
              std::string::npos);
    EXPECT_NE(error({{"xmag", 1.0}, {"ymag", 1.0}, {"znear", -1.0}, {"zfar", 1.0}}).find("znear"),
              std::string::npos);
}

TEST(GltfReader, ReadsPunctualLights) {
    GltfBuilder builder = GltfBuilder::triangle();
    const Json spot = {{"type", "spot"},
                       {"color", {1, 0.5, 0}},
                       {"intensity", 8},
                       {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        spot, {{"type", "point"}, {"range", 3}}, {{"type", "directional"}, {"intensity", 2}}};
    builder.json["extensionsRequired"] = {"KHR_lights_punctual"};
    const double half = std::sqrt(0.5);
    builder.json["nodes"] = Json::array();
    for (int i = 0; i < 3; ++i)
        builder.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}},
                                         {"translation", {i, 0, 0}},
                                         {"scale", {3, 3, 3}},
                                         {"rotation", {-half, 0, 0, half}}});
    builder.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.lights.size(), 3U);
    EXPECT_EQ(scene.lights[0].type, LightType::spot);
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(8, 4, 0));
    EXPECT_FLOAT_EQ(scene.lights[0].cos_inner, std::cos(0.25F));
    EXPECT_FLOAT_EQ(scene.lights[0].cos_outer, std::cos(0.5F));
    expect_near(scene.lights[0].direction, {0, -1, 0});  // -z turned by -90 degrees about x
    EXPECT_EQ(scene.lights[1].type, LightType::point);
    EXPECT_EQ(scene.lights[1].position, glm::dvec3(1, 0, 0));
    EXPECT_EQ(scene.lights[2].type, LightType::directional);
    EXPECT_EQ(scene.lights[2].intensity, glm::vec3(2.0F));
    EXPECT_TRUE(builder.warned_at(
        "lights/1", "range is not simulated, light fades with the square of the distance only"));
}

TEST(GltfReader, ReadsOnlyWhatTheSceneRefersTo) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 99}}}}}}});
    builder.json["images"] = {{{"uri", "missing.png"}}};
    builder.json["buffers"] = {{{"byteLength", builder.binary.size()},
                                {"uri", "data:;base64," + encode_base64(builder.binary)}},
                               {{"byteLength", 5}, {"uri", "missing.bin"}}};
    EXPECT_EQ(builder.read().meshes.size(), 1U);
}

TEST(GltfReader, WarnsOfWhatItDoesNotSimulate) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["extensionsUsed"] = {"EXT_unheard_of", "KHR_materials_unlit"};
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["skins"] = {{{"joints", {0}}}};
    builder.read();
    EXPECT_TRUE(builder.warned("#/extensionsUsed/0: extension 'EXT_unheard_of' is not"));
    EXPECT_TRUE(builder.warned_at(
        "#/nodes/0", "the skin needs JOINTS_0 and WEIGHTS_0 of the mesh, it is left out"));
    EXPECT_EQ(builder.diagnostics.warnings().size(), 2U);
}

}  // namespace
}  // namespace weft::gltf_reader_test
