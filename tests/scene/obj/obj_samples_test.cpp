// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "scene/load/load_scene.h"
#include "scene/obj/obj_mtl.h"

namespace weft::obj_samples_test {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
    const char* shared = std::getenv("WEFT_SHARED");
    return (shared != nullptr ? fs::path(shared) : fs::path(WEFT_SOURCE_DIR) / ".." / "shared") /
           "data";
}

std::vector<fs::path> files_below(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> files;
    if (!fs::is_directory(folder)) return files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        std::string found = entry.path().extension().string();
        for (char& c : found) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
        if (entry.is_regular_file() && found == extension) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

struct Counts {
    int loaded = 0;
    int refused = 0;
    std::vector<std::string> errors{};
};

/// Calls `read` for a file and expects it to end soon, well or with exit code 2.
template <typename Read>
void try_file(const fs::path& file, Counts& counts, const Read& read) {
    const auto start = std::chrono::steady_clock::now();
    try {
        read();
        ++counts.loaded;
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(error.code(), ExitCode::bad_input) << text;
        EXPECT_NE(text.find(file.stem().string()), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        ++counts.refused;
        counts.errors.push_back(text);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    // Takes milliseconds; the limit only tells a reader that hangs.
    EXPECT_LT(seconds.count(), 2.0) << file;
}

void print(const char* what, const Counts& counts) {
    std::cout << what << ": " << counts.loaded << " loaded, " << counts.refused << " refused\n";
}

TEST(ObjSamples, EveryMeshLoadsOrIsRefused) {
    Counts counts;
    for (const char* folder : {"malformed/obj-dialects-ufbx", "malformed/obj-tinyobjloader",
                               "malformed/mixed-assimp", "meshes"}) {
        for (const char* extension : {".obj", ".ply"}) {
            for (const fs::path& file : files_below(data_folder() / folder, extension)) {
                Diagnostics diagnostics;
                try_file(file, counts, [&] { (void)load_scene(file, diagnostics); });
            }
        }
    }
    if (counts.loaded + counts.refused == 0) GTEST_SKIP() << "no meshes below " << data_folder();
    print("OBJ and PLY files", counts);
    EXPECT_GT(counts.loaded, 0);
    EXPECT_GT(counts.refused, 0);
}

TEST(ObjSamples, EveryDialectLoads) {
    Counts counts;
    const fs::path folder = data_folder() / "malformed" / "obj-dialects-ufbx";
    for (const fs::path& file : files_below(folder, ".obj")) {
        // Files of fuzzers, and one that names corner 0 on purpose.
        if (file.parent_path() != folder || file.stem() == "synthetic_partial_attrib_face_0_obj")
            continue;
        Diagnostics diagnostics;
        try_file(file, counts, [&] { (void)load_scene(file, diagnostics); });
    }
    if (counts.loaded + counts.refused == 0) GTEST_SKIP() << "no dialects below " << folder;
    print("dialects", counts);
    // Files of lines and points alone.
    std::erase_if(counts.errors, [](const std::string& error) {
        return error.ends_with("holds no faces that can be rendered, expected a mesh");
    });
    EXPECT_TRUE(counts.errors.empty()) << counts.errors[0];
}

TEST(ObjSamples, EveryMtlFileIsReadOrRefused) {
    Counts counts;
    for (const fs::path& file : files_below(data_folder() / "malformed", ".mtl")) {
        Diagnostics diagnostics;
        WarningCollector report(diagnostics);
        std::map<std::string, MtlMaterial, std::less<>> materials;
        const std::vector<std::byte> bytes = read_file(file, std::size_t{1} << 20);
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        try_file(file, counts,
                 [&] { parse_mtl(text, file.string(), report, MaterialDetail::full, materials); });
    }
    if (counts.loaded + counts.refused == 0) GTEST_SKIP() << "no files below " << data_folder();
    print("MTL files", counts);
    EXPECT_GT(counts.loaded, 0);
}

}  // namespace
}  // namespace weft::obj_samples_test
