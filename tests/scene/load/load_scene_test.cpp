// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/load/load_scene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "tests/testing/temporary_folder.h"

namespace weft::load_scene_test {
namespace {

constexpr const char* empty_gltf = R"({"asset": {"version": "2.0"}})";

std::string error_of(const std::filesystem::path& path) {
    Diagnostics ignored;
    try {
        (void)load_scene(path, ignored);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

TEST(LoadScene, ChoosesTheReaderByExtensionInAnyCase) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.GlTf", empty_gltf);
    Diagnostics diagnostics;
    EXPECT_EQ(load_scene(path, diagnostics).source, path.string());
    // Not glTF to the reader of XML, whatever it says about it.
    EXPECT_NE(error_of(folder.write("a.XML", empty_gltf)), "no error");
}

TEST(LoadScene, NamesTheKnownFormats) {
    for (const char* name : {"a.stl", "a", ".gltf", "a.gltf.bak"})
        EXPECT_EQ(error_of(name), std::string(name) +
                                      ": is not a known kind of scene file, expected glTF 2.0 "
                                      "(.gltf, .glb), Mitsuba 3 (.xml), OBJ (.obj) or PLY (.ply)");
}

TEST(LoadScene, SaysThatAFileIsMissing) {
    const TemporaryFolder folder;
    EXPECT_EQ(error_of(folder.path()),
              folder.path().string() + ": is a folder, expected a scene file");
    const std::string path = (folder.path() / "none.gltf").string();
    EXPECT_EQ(error_of(path), path + ": cannot be opened: No such file or directory");
}

TEST(LoadScene, ValidatesWhatItRead) {
    const TemporaryFolder folder;
    const auto path = folder.write(
        "a.gltf",
        R"({"asset": {"version": "2.0"}, "extensions": {"KHR_lights_punctual": {"lights":
        [{"type": "point"}]}}, "nodes": [{"name": "far", "translation": [1e16, 0, 0],
        "extensions": {"KHR_lights_punctual": {"light": 0}}}]})");
    EXPECT_EQ(error_of(path), path.string() + ": light 'far' lies too far from the origin");
}

TEST(LoadScene, PutsAnImageInPlaceOfTheEnvironment) {
    const TemporaryFolder folder;
    const auto scene_file = folder.write("a.xml", R"(<scene version="3.0.0">
        <emitter type="constant"/></scene>)");
    SceneReading reading;
    reading.environment = folder.write(
        "sky.hdr", std::string("#?RADIANCE\n\n-Y 1 +X 2\n\x80\x80\x80\x81\x80\x80\x80\x82", 30));
    Diagnostics diagnostics;
    const Scene plain = load_scene(scene_file, diagnostics, reading);
    ASSERT_TRUE(plain.environment && plain.environment->image);
    EXPECT_EQ(plain.environment->radiance, glm::vec3(1.0F));
    EXPECT_EQ(plain.environment->image->radiance, (std::vector<float>{1, 1, 1, 2, 2, 2}));
    EXPECT_EQ(plain.environment->to_world, glm::dmat3(1.0));
    // Counter-clockwise seen from above, so that +z comes to lie at +x.
    reading.environment_rotation = 90.0;
    const Scene turned = load_scene(scene_file, diagnostics, reading);
    EXPECT_NEAR(
        glm::length(turned.environment->to_world * glm::dvec3(0, 0, 1) - glm::dvec3(1, 0, 0)), 0.0,
        1e-12);
    EXPECT_TRUE(diagnostics.warnings().empty());
    reading.environment.clear();
    EXPECT_FALSE(load_scene(scene_file, diagnostics, reading).environment->image);
    EXPECT_EQ(diagnostics.warnings().size(), 1U);
    reading.environment = folder.path() / "none.hdr";
    EXPECT_THROW((void)load_scene(scene_file, diagnostics, reading), Error);
}

}  // namespace
}  // namespace weft::load_scene_test
