// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Published scenes, where they are at hand.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/mitsuba/mitsuba_reader.h"

namespace weft::mitsuba_scenes_test {
namespace {

namespace fs = std::filesystem;

fs::path scenes_folder() {
    const char* const shared = std::getenv("WEFT_SHARED");
    const fs::path folder =
        shared != nullptr ? fs::path(shared) : fs::path(WEFT_SOURCE_DIR) / "../shared";
    return folder / "data/scenes";
}

struct Expected {
    std::string file;
    std::size_t triangles;
    std::size_t emitters;
    std::size_t textures;
    bool fog;
};

std::size_t count_triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        count += scene.meshes.at(instance.mesh).triangles.size();
    return count;
}

std::size_t count_emitters(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        count +=
            scene.materials.at(instance.material).emission.radiance != glm::vec3(0.0F) ? 1U : 0U;
    return count;
}

TEST(MitsubaScenes, PublishedScenesLoadCompletely) {
    const fs::path folder = scenes_folder();
    if (!fs::is_directory(folder)) GTEST_SKIP() << "no scenes in " << folder;
    const std::vector<Expected> scenes = {
        {"cornell-box/cornell-box.xml", 36, 1, 0, false},
        {"cornell-box/cornell-box-fog.xml", 36, 1, 0, true},
        {"sibenik/sibenik.xml", 75285, 4, 3, false},
        {"sibenik/sibenik-fog.xml", 75285, 4, 3, true},
        {"conference/conference.xml", 331191, 6, 0, false},
        {"office/office.xml", 35100, 2, 0, false},
        {"office/office-fog.xml", 35100, 2, 0, true},
        {"desk/desk.xml", 46472, 2, 0, false},
    };
    for (const Expected& expected : scenes) {
        SCOPED_TRACE(expected.file);
        Diagnostics diagnostics;
        const Scene scene = read_mitsuba(folder / expected.file, diagnostics);
        EXPECT_EQ(count_triangles(scene), expected.triangles);
        EXPECT_EQ(count_emitters(scene), expected.emitters);
        EXPECT_EQ(scene.textures.size(), expected.textures);
        EXPECT_EQ(scene.cameras.size(), 1U);
        EXPECT_EQ(scene.film->width, 512U);
        EXPECT_EQ(scene.film->height, 512U);
        EXPECT_EQ(scene.media.size(), expected.fog ? 1U : 0U);
        EXPECT_EQ(scene.medium_boundaries.size(), expected.fog ? 1U : 0U);
        EXPECT_EQ(scene.camera_medium, expected.fog ? 0 : -1);
        EXPECT_TRUE(diagnostics.warnings().empty());
        for (const Material& material : scene.materials) EXPECT_TRUE(material.two_sided);
    }
}

}  // namespace
}  // namespace weft::mitsuba_scenes_test
