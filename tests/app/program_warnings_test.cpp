// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "base/shorten.h"
#include "base/warning.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

namespace weft::program_warnings_test {
namespace {

using test::ProgramResult;
using test::run_program;
using test::RunningProgram;
using test::shipped_scene;
using Strings = std::vector<std::string>;

/// A triangle of three materials, all bumpy, and one that has a sheen besides.
std::string bumpy_scene(const TemporaryFolder& folder) {
    folder.write("bumpy.mtl",
                 "newmtl a\nbump b.png\nnewmtl b\nbump b.png\nPs 0.5\nnewmtl c\nbump b.png\n");
    return folder.write("bumpy.obj",
                        "mtllib bumpy.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"
                        "usemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n");
}

Strings lines_of(const std::string& text) {
    Strings lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Lines of standard error, without the test's folder.
Strings messages(std::string text, const TemporaryFolder& folder) {
    const std::string prefix = folder.path().string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
        text.erase(at, prefix.size());
    return lines_of(text);
}

const std::string bumps =
    "weft: warning: 3 materials: bump and displacement maps are not simulated";
const std::string sheen = "weft: warning: 1 material: sheen is not simulated; at bumpy.mtl:5";

TEST(ProgramWarnings, ComeWhileRenderingHasNotEnded) {
    const TemporaryFolder folder;
    RunningProgram program({"render", bumpy_scene(folder), "--spp", "10000000", "--size", "64x64",
                            "--backend", "embree", "--progress", "none", "-o",
                            folder.path() / "x.png"});
    ASSERT_TRUE(program.wait_for_lines(3));
    const Strings lines = messages(program.err(), folder);
    EXPECT_EQ(lines[0], bumps + "; first: bumpy.mtl:2");
    EXPECT_EQ(lines[1], sheen);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.png"));
}

TEST(ProgramWarnings, AreOneLineAKindForInfoAndNoneOfAGoodScene) {
    const TemporaryFolder folder;
    const ProgramResult info = run_program({"info", bumpy_scene(folder)});
    EXPECT_EQ(info.exit_code, 0);
    const Strings lines = messages(info.err, folder);
    ASSERT_GE(lines.size(), 2U);
    EXPECT_EQ(lines[0], bumps + "; first: bumpy.mtl:2");
    EXPECT_EQ(lines[1], sheen);
    EXPECT_EQ(run_program({"info", shipped_scene("cornell-box.gltf")}).err, "");
}

TEST(ProgramWarnings, NameEveryPlaceWithVerbose) {
    const TemporaryFolder folder;
    const ProgramResult info = run_program({"info", "--verbose", bumpy_scene(folder)});
    const Strings lines = messages(info.err, folder);
    ASSERT_GE(lines.size(), 5U);
    EXPECT_EQ(Strings(lines.begin(), lines.begin() + 5),
              (Strings{bumps, "weft:   bumpy.mtl:2", "weft:   bumpy.mtl:4", "weft:   bumpy.mtl:7",
                       sheen}));
}

TEST(ProgramWarnings, FitIntoALineWhateverTheFolder) {
    const TemporaryFolder folder;
    std::string deep = "a-folder-with-a-long-name/";
    deep += deep + deep + deep;
    std::filesystem::create_directories(folder.path() / deep);
    const std::filesystem::path scene = folder.path() / deep / "bumpy.obj";
    (void)bumpy_scene(folder);
    std::filesystem::rename(folder.path() / "bumpy.obj", scene);
    std::filesystem::rename(folder.path() / "bumpy.mtl", scene.parent_path() / "bumpy.mtl");
    const Strings lines = lines_of(run_program({"info", scene.string()}).err);
    ASSERT_GE(lines.size(), 2U);
    for (const std::string& line : lines) EXPECT_LE(count_characters(line), longest_warning_line);
    EXPECT_TRUE(lines[0].starts_with(bumps + "; first: .../")) << lines[0];
    EXPECT_TRUE(lines[0].ends_with("/bumpy.mtl:2")) << lines[0];
}

TEST(ProgramWarnings, PrecedeAnError) {
    const TemporaryFolder folder;
    const std::string scene = bumpy_scene(folder);
    const ProgramResult result = run_program(
        {"render", scene, "--camera", "none", "--progress", "none", "-o", folder.path() / "x.png"});
    EXPECT_EQ(result.exit_code, 1);
    const Strings lines = messages(result.err, folder);
    ASSERT_GE(lines.size(), 3U);
    EXPECT_EQ(lines[0], bumps + "; first: bumpy.mtl:2");
    EXPECT_TRUE(lines.back().starts_with("weft: --camera")) << lines.back();
}

}  // namespace
}  // namespace weft::program_warnings_test
