// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "components/component.h"

// A component touches its own files, one line of one list, and for each of its kernels a line of
// another and its signature: held against the sources for the example that
// docs/adding-a-component.md walks through.
namespace weft::component_list_test {
namespace {

namespace fs = std::filesystem;

const std::string example = "ambient_occlusion";
const std::string component_line = "WEFT_COMPONENT(ambient_occlusion)";
const std::string kernel_line = "WEFT_KERNEL_ENTRY(ambient_occlusion, ";
const std::string signature_line = "#define ARGUMENTS_ambient_occlusion(X) ";

std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<std::string> lines_of(const fs::path& file) {
    std::vector<std::string> lines;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// Every line of the program that names `word` outside of the example's own files, as "file: line".
std::vector<std::string> mentions(const std::string& word) {
    const fs::path root = WEFT_SOURCE_DIR;
    std::vector<std::string> found;
    const auto look_at = [&](const fs::path& file) {
        if (file.stem() == example) return;
        for (const std::string& line : lines_of(file))
            if (line.find(word) != std::string::npos)
                found.push_back(file.lexically_relative(root).generic_string() + ": " + line);
    };
    for (const char* folder : {"host", "kernels", "cmake"})
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
            if (entry.is_regular_file()) look_at(entry.path());
    for (const char* file : {"CMakeLists.txt", "tests/CMakeLists.txt"}) look_at(root / file);
    std::sort(found.begin(), found.end());
    return found;
}

TEST(ComponentList, TheExampleIsRegisteredByOneLineAndTwoForItsKernel) {
    const std::vector<std::string> found = mentions(example);
    ASSERT_EQ(found.size(), 3U) << testing::PrintToString(found);
    EXPECT_EQ(found[0], "host/components/components.def: " + component_line);
    EXPECT_TRUE(found[1].starts_with("kernels/core/kernels.def: " + kernel_line)) << found[1];
    EXPECT_TRUE(found[2].starts_with("kernels/core/signatures.h: " + signature_line)) << found[2];
    // The name it has for users is its own file's matter, too.
    EXPECT_TRUE(mentions("\"occlusion\"").empty());
    // The check sees what is there.
    EXPECT_FALSE(mentions("soft_shadows").empty());
}

TEST(ComponentList, TheWalkthroughNamesTheLinesAndFilesThereAre) {
    const fs::path root = WEFT_SOURCE_DIR;
    const std::string page = text_of(root / "docs/adding-a-component.md");
    ASSERT_FALSE(page.empty());
    for (const std::string& line : mentions(example))
        EXPECT_NE(page.find(line.substr(line.find(": ") + 2)), std::string::npos) << line;
    for (const char* file :
         {"host/components/components.def", "host/components/ambient_occlusion.cpp",
          "kernels/adaptive/ambient_occlusion.cl", "kernels/core/kernels.def",
          "kernels/core/signatures.h", "kernels/core/buffers.def", "host/pipeline/stages.def",
          "tests/components/ambient_occlusion_test.cpp"}) {
        EXPECT_TRUE(fs::exists(root / file)) << file;
        EXPECT_NE(page.find(file), std::string::npos) << file;
    }
}

TEST(ComponentList, NamesAreDistinctAndThoseOfTheImageComeFirst) {
    std::set<std::string> names;
    for (const ComponentKind& kind : components()) names.insert(kind.name);
    EXPECT_EQ(names.size(), components().size());
    const std::vector<std::string_view> all = choosable_components();
    ASSERT_GE(all.size(), 3U);
    EXPECT_EQ(all[0], "direct");
    EXPECT_EQ(all[1], "indirect");
    EXPECT_NE(std::find(all.begin(), all.end(), "occlusion"), all.end());
}

TEST(ComponentList, PlansWithoutRequestsCallForNoneThatHasToBeAskedFor) {
    FramePlan plan;
    for (const ComponentKind& kind : components())
        if (kind.choice == Choice::on_request) {
            EXPECT_FALSE(kind.is_enabled(plan)) << kind.name;
            FramePlan asking;
            asking.requested = {kind.name};
            EXPECT_TRUE(kind.is_enabled(asking)) << kind.name;
        }
}

}  // namespace
}  // namespace weft::component_list_test
