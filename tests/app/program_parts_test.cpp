// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "film/film_sums_file.h"
#include "image/exr.h"
#include "tests/testing/expect_line.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

// References that jobs render in parts: which part, whether it is there, and what is missing.
namespace weft::program_parts_test {
namespace {

namespace fs = std::filesystem;
using test::expect_line;
using test::ProgramResult;
using test::run_program;
using test::RunningProgram;

class ProgramParts : public testing::Test {
  protected:
    [[nodiscard]] std::string at(const std::string& name) const { return folder_.path() / name; }

    [[nodiscard]] std::vector<std::string> render_arguments(
        const std::string& file, const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"render",      test::shipped_scene("cornell-box.gltf"),
                                           "-o",          at(file),
                                           "--backend",   "native",
                                           "--algorithm", "path",
                                           "--size",      "16x12",
                                           "--progress",  "none"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    [[nodiscard]] ProgramResult render(const std::string& file,
                                       const std::vector<std::string>& more) const {
        return run_program(render_arguments(file, more));
    }

    [[nodiscard]] ProgramResult merge(const std::vector<std::string>& parts,
                                      const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"merge"};
        for (const std::string& part : parts) arguments.push_back(at(part));
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments);
    }

  private:
    TemporaryFolder folder_;
};

TEST_F(ProgramParts, PartsTogetherAreTheWholeBitForBit) {
    ASSERT_EQ(render("whole.exr", {"--samples", "0:7"}).exit_code, 0);
    for (const std::string part : {"1", "2", "3"})
        ASSERT_EQ(render(part + ".exr", {"--spp", "7", "--part", part + "/3"}).exit_code, 0);
    ASSERT_EQ(merge({"3.exr", "1.exr", "2.exr"}, {"--expect", "0:7", "-o", at("m.exr")}).exit_code,
              0);
    const Image whole = read_exr(at("whole.exr"));
    const Image merged = read_exr(at("m.exr"));
    ASSERT_EQ(whole.layers.size(), merged.layers.size());
    for (std::size_t i = 0; i < whole.layers.size(); ++i) {
        const std::vector<float>& a = whole.layers[i].values;
        const std::vector<float>& b = merged.layers[i].values;
        ASSERT_EQ(a.size(), b.size());
        EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0)
            << whole.layers[i].name;
    }
}

TEST_F(ProgramParts, AGapIsAnErrorAndWritesNothing) {
    ASSERT_EQ(render("1.exr", {"--spp", "8", "--part", "1/4"}).exit_code, 0);
    ASSERT_EQ(render("3.exr", {"--spp", "8", "--part", "3/4"}).exit_code, 0);
    const ProgramResult result =
        merge({"1.exr", "3.exr"}, {"--expect", "0:8", "-o", at("whole.exr")});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("lacks the samples 2:4,6:8"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(at("whole.exr")));
    const ProgramResult others =
        merge({"1.exr", "3.exr"}, {"--expect", "4:6", "-o", at("whole.exr")});
    EXPECT_EQ(others.exit_code, 2);
    EXPECT_NE(others.err.find("expected no others than 4:6"), std::string::npos) << others.err;
    EXPECT_FALSE(fs::exists(at("whole.exr")));
}

TEST_F(ProgramParts, MissingPartsAreToldAsJobArraysTakeThem) {
    ASSERT_EQ(render("2.exr", {"--spp", "8", "--part", "2/4"}).exit_code, 0);
    const std::vector<std::string> parts{"1.exr", "2.exr", "3.exr", "4.exr"};
    const ProgramResult some = merge(parts, {"--expect", "0:8", "--missing", "4"});
    EXPECT_EQ(some.exit_code, 0);
    EXPECT_EQ(some.out, "1,3,4\n");
    for (const std::string part : {"1", "3", "4"})
        ASSERT_EQ(render(part + ".exr", {"--spp", "8", "--part", part + "/4"}).exit_code, 0);
    EXPECT_EQ(merge(parts, {"--expect", "0:8", "--missing", "4"}).out, "\n");
    // A part of another image is none of this one.
    ASSERT_EQ(render("1.exr", {"--spp", "8", "--part", "1/4", "--seed", "1"}).exit_code, 0);
    EXPECT_EQ(merge(parts, {"--expect", "0:8", "--missing", "4"}).exit_code, 2);
}

TEST_F(ProgramParts, WhatCannotBeMergedSaysWhy) {
    ASSERT_EQ(render("1.exr", {"--samples", "0:1"}).exit_code, 0);
    // The folder is looked for before parts are read.
    const ProgramResult no_folder = merge({"1.exr"}, {"-o", at("gone/m.exr")});
    EXPECT_EQ(no_folder.exit_code, 5);
    expect_line(no_folder.err, {at("gone"), "to be a folder"});
    const std::string long_name = std::string(300, 'x') + ".exr";
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--expect", "0:1", "--missing", "1"}, {"-o", at("m.exr")}}) {
        const ProgramResult result = merge({long_name}, more);
        EXPECT_EQ(result.exit_code, 2);
        expect_line(result.err, {long_name, "cannot be opened"});
    }
    const ProgramResult resumed = render("2.exr", {"--spp", "1", "--resume", at(long_name)});
    EXPECT_EQ(resumed.exit_code, 2);
    expect_line(resumed.err, {long_name, "cannot be opened"});
    const Image whole = read_exr(at("1.exr"));
    FilmSums sums = sums_of(whole, "1.exr");
    sums.ranges.clear();
    Image image;
    image.width = whole.width;
    image.height = whole.height;
    attach_sums(sums, image);
    write_exr(at("none.exr"), image);
    const ProgramResult none = merge({"none.exr"}, {"-o", at("m.exr")});
    EXPECT_EQ(none.exit_code, 2);
    expect_line(none.err, {at("none.exr"), "has no samples"});
    EXPECT_FALSE(fs::exists(at("m.exr")));
}

TEST_F(ProgramParts, MissingPartsThatCannotBeToldAreCodeFive) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    RunningProgram::Settings settings;
    settings.standard_output = "/dev/full";
    const ProgramResult result =
        run_program({"merge", at("1.exr"), "--expect", "0:1", "--missing", "1"}, settings);
    EXPECT_EQ(result.exit_code, 5);
    expect_line(result.err, {"weft: "});
}

TEST_F(ProgramParts, AFileThatMayNotGrowIsCodeFive) {
    RunningProgram::Settings settings;
    settings.file_bytes = 1024;
    const ProgramResult result = run_program(render_arguments("1.exr", {"--spp", "1"}), settings);
    EXPECT_EQ(result.exit_code, 5);
    expect_line(result.err, {at("1.exr"), "cannot be written"});
    EXPECT_TRUE(fs::is_empty(at(""))) << fs::directory_iterator(at(""))->path();
}

TEST_F(ProgramParts, WhatIsCompleteIsKept) {
    const std::vector<std::string> part{"--spp", "8", "--part", "1/2", "--keep-complete"};
    ASSERT_EQ(render("1.exr", part).exit_code, 0);
    const auto written = fs::last_write_time(at("1.exr"));
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = part;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    ASSERT_EQ(render("1.exr", part).exit_code, 0);
    EXPECT_EQ(fs::last_write_time(at("1.exr")), written);
    // Another image, and a file that was cut off, are rendered anew.
    ASSERT_EQ(render("1.exr", with({"--seed", "1"})).exit_code, 0);
    const auto anew = fs::last_write_time(at("1.exr"));
    EXPECT_NE(anew, written);
    fs::resize_file(at("1.exr"), fs::file_size(at("1.exr")) / 2);
    ASSERT_EQ(render("1.exr", with({"--seed", "1"})).exit_code, 0);
    EXPECT_EQ(read_exr(at("1.exr")).metadata.at("seed"), "1");
    // So is another part.
    ASSERT_EQ(render("1.exr", {"--spp", "8", "--part", "2/2", "--keep-complete"}).exit_code, 0);
    EXPECT_EQ(merge({"1.exr"}, {"--expect", "4:8", "--missing", "1"}).out, "\n");
}

// What a machine that fails may lose is what came after the last checkpoint, and never the file.
TEST_F(ProgramParts, AKilledProgramGoesOnFromItsCheckpoint) {
    test::RunningProgram program(render_arguments(
        "killed.exr", {"--spp", "16777216", "--resume", at("sums.exr"), "--checkpoint", "20ms"}));
    constexpr int tries = 6000;
    for (int i = 0; i < tries && !fs::exists(at("sums.exr")); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(fs::exists(at("sums.exr")));
    program.send(SIGKILL);
    EXPECT_EQ(program.wait(), 1000 + SIGKILL);
    const FilmSums sums = sums_of(read_exr(at("sums.exr")), "sums.exr");
    ASSERT_EQ(sums.ranges.size(), 1U);
    ASSERT_GT(sums.ranges[0].end, 0U);
    const std::string count = std::to_string(sums.ranges[0].end + 2);
    ASSERT_EQ(render("resumed.exr", {"--spp", count, "--resume", at("sums.exr")}).exit_code, 0);
    ASSERT_EQ(render("straight.exr", {"--spp", count}).exit_code, 0);
    EXPECT_EQ(read_exr(at("resumed.exr")).find("")->values,
              read_exr(at("straight.exr")).find("")->values);
}

TEST_F(ProgramParts, WhatMakesNoPartIsRefused) {
    const std::vector<std::vector<std::string>> refused{
        {"--part", "1/2"},
        {"--spp", "8", "--part", "0/2"},
        {"--spp", "8", "--part", "3/2"},
        {"--spp", "8", "--part", "1"},
        {"--spp", "8", "--part", "1/9"},
        {"--spp", "8", "--part", "1/2", "--samples", "0:4"},
        {"--spp", "8", "--keep-complete"},
        {"--spp", "8", "--checkpoint", "1s"}};
    for (const std::vector<std::string>& options : refused) {
        const ProgramResult result = render("1.exr", options);
        EXPECT_EQ(result.exit_code, 1) << options.back();
        EXPECT_NE(result.err.find("expected"), std::string::npos) << result.err;
    }
    EXPECT_EQ(merge({"1.exr"}, {"--missing", "2"}).exit_code, 1);
    EXPECT_EQ(merge({"1.exr"}, {"--expect", "0:8", "--missing", "9"}).exit_code, 1);
    EXPECT_EQ(merge({"1.exr"}, {"--expect", "0:8", "--missing", "2", "-o", at("a.exr")}).exit_code,
              1);
}

}  // namespace
}  // namespace weft::program_parts_test
