// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/gltf/gltf_reader.h"
#include "scene/validate_scene.h"

namespace weft::gltf_samples_test {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
    const char* shared = std::getenv("WEFT_SHARED");
    return (shared != nullptr ? fs::path(shared) : fs::path(WEFT_SOURCE_DIR) / ".." / "shared") /
           "data";
}

std::vector<fs::path> gltf_files(const fs::path& folder) {
    std::vector<fs::path> files;
    if (!fs::is_directory(folder)) return files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path extension = entry.path().extension();
        if (entry.is_regular_file() && (extension == ".gltf" || extension == ".glb"))
            files.push_back(entry.path());
    }
    return files;
}

Scene read_valid(const fs::path& path, Diagnostics& diagnostics) {
    Scene scene = read_gltf(path, diagnostics);
    validate_scene(scene);
    return scene;
}

std::size_t placed_triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        count += scene.meshes[instance.mesh].triangles.size();
    return count;
}

TEST(GltfSamples, EveryKhronosSampleLoads) {
    const std::vector<fs::path> files = gltf_files(data_folder() / "gltf");
    if (files.empty()) GTEST_SKIP() << "no sample models below " << data_folder();
    for (const fs::path& file : files) {
        Diagnostics diagnostics;
        try {
            const Scene scene = read_valid(file, diagnostics);
            EXPECT_GT(placed_triangles(scene), 0U) << file;
        } catch (const Error& error) {
            ADD_FAILURE() << error.what();
        }
    }
}

TEST(GltfSamples, KnownContents) {
    const fs::path folder = data_folder() / "gltf";
    if (!fs::is_directory(folder)) GTEST_SKIP() << "no sample models below " << data_folder();
    const std::map<std::string, std::size_t> triangles = {
        {"BoxTextured/glTF-Binary/BoxTextured.glb", 12},
        {"BoxInterleaved/glTF-Binary/BoxInterleaved.glb", 12},
        {"Duck/glTF-Binary/Duck.glb", 4212},
        {"SimpleMeshes/glTF/SimpleMeshes.gltf", 2},
        {"TriangleWithoutIndices/glTF/TriangleWithoutIndices.gltf", 1}};
    for (const auto& [name, count] : triangles) {
        if (!fs::exists(folder / name)) continue;
        Diagnostics diagnostics;
        EXPECT_EQ(placed_triangles(read_valid(folder / name, diagnostics)), count) << name;
    }
    if (!fs::exists(folder / "Duck/glTF-Binary/Duck.glb")) return;
    Diagnostics diagnostics;
    const Scene duck = read_valid(folder / "Duck/glTF-Binary/Duck.glb", diagnostics);
    EXPECT_EQ(duck.textures.size(), 1U);
    EXPECT_EQ(duck.cameras.size(), 1U);
    EXPECT_NEAR(duck.cameras[0].fov, 0.6605925559997559, 1e-12);
}

TEST(GltfSamples, MalformedFilesLoadOrAreRefusedInBoundedTime) {
    std::size_t loaded = 0;
    std::size_t refused = 0;
    for (const char* name : {"gltf-validator", "gltf-tinygltf", "gltf-cgltf"}) {
        for (const fs::path& file : gltf_files(data_folder() / "malformed" / name)) {
            const auto start = std::chrono::steady_clock::now();
            Diagnostics diagnostics;
            try {
                (void)read_valid(file, diagnostics);
                ++loaded;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::bad_input) << error.what();
                EXPECT_NE(std::string(error.what()).find(file.filename().string()),
                          std::string::npos);
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
                ++refused;
            }
            EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10)) << file;
        }
    }
    if (loaded + refused == 0) GTEST_SKIP() << "no malformed files below " << data_folder();
    RecordProperty("loaded", static_cast<int>(loaded));
    RecordProperty("refused", static_cast<int>(refused));
    EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace weft::gltf_samples_test
