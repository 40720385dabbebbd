// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "image/exr.h"
#include "plan/preset.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

namespace weft::tradeoff_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;
using test::run_program;
using test::shipped_scene;
using test::text_of_file;

class TradeoffCommand : public testing::Test {
  protected:
    [[nodiscard]] std::string at(const std::string& name) const { return folder_.path() / name; }

    /// A small run on the shipped box, with references in the test's own folder.
    [[nodiscard]] std::vector<std::string> box(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"tradeoff",     shipped_scene("cornell-box.gltf"),
                                           "-o",           at("out"),
                                           "--size",       "32x24",
                                           "--references", at("references"),
                                           "--backend",    "native",
                                           "--progress",   "none"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    [[nodiscard]] json report() const { return json::parse(text_of_file(at("out/tradeoff.json"))); }

    TemporaryFolder folder_;
};

const std::vector<std::string> small{"--quick", "--repetitions", "4",           "--reference-spp",
                                     "16",      "--algorithms",  "igi,ic,path", "--budget",
                                     "60s"};

std::size_t lines_of(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_F(TradeoffCommand, WritesAllThatItFound) {
    // Without Open Image Denoise, which some machines have, and with what stands in for it below.
    const ProgramResult result =
        run_program(box(small), {.environment = {{"WEFT_OIDN_LIBRARY", at("none.so")}}});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_NE(result.out.find("for 60 s the best is "), std::string::npos) << result.out;
    const json found = report();
    EXPECT_EQ(found["weft_tradeoff"], 1);
    EXPECT_EQ(found["scene"], "cornell-box.gltf");
    EXPECT_EQ(found["size"], (json{32, 24}));
    EXPECT_EQ(found["measure"], "hdrflip");
    EXPECT_EQ(found["reference"]["samples"], 16);
    EXPECT_GT(found["reference"]["noise_floor"]["relmse"].get<double>(), 0.0);
    EXPECT_GT(found["reference"]["noise_relmse"].get<double>(), 0.0);
    EXPECT_NE(result.out.find("unbiased relMSE"), std::string::npos) << result.out;
    EXPECT_EQ(found["machine"]["backend"], "native");
    EXPECT_TRUE(found["check"].is_null());
    // igi, ic, and path with 4, 16 and 64 samples, and with 16 denoised.
    ASSERT_EQ(found["points"].size(), 6U);
    EXPECT_EQ(found["time_spread"]["deviations"], 24);
    EXPECT_GT(found["time_spread"]["factor"], 1.0);
    EXPECT_GE(found["time_spread"]["degrees"], 3.0);
    bool any_on_front = false;
    double before = 0.0;
    for (const json& point : found["points"]) {
        const json& ms = point["ms"];
        EXPECT_GT(ms["low"], 0.0);
        EXPECT_LE(ms["low"], ms["median"]);
        EXPECT_LE(ms["median"], ms["high"]);
        EXPECT_GE(ms["median"].get<double>(), before);
        before = ms["median"].get<double>();
        EXPECT_GT(point["rays"], 0);
        EXPECT_EQ(point["runs"].size(), 4U);
        EXPECT_EQ(point["errors"].size(), 7U);
        EXPECT_GT(point["errors"]["hdrflip"]["median"], 0.0);
        const json& unbiased = point["unbiased_relmse"];
        EXPECT_LT(unbiased["low"], unbiased["value"]);
        EXPECT_LT(unbiased["value"], unbiased["high"]);
        double mean = 0.0;
        for (const json& run : point["runs"])
            mean += run["unbiased_relmse"]["value"].get<double>() / 4.0;
        EXPECT_NEAR(unbiased["value"].get<double>(), mean, 1e-12);
        EXPECT_TRUE(point["within_floor"].is_boolean());
        any_on_front = any_on_front || point["on_front"].get<bool>();
    }
    EXPECT_TRUE(any_on_front);
    EXPECT_EQ(lines_of(text_of_file(at("out/tradeoff.csv"))), 7U);
    EXPECT_NE(text_of_file(at("out/index.html")).find("<html"), std::string::npos);
}

TEST_F(TradeoffCommand, MeasuresDenoisedPathsLikeAnyOtherSetting) {
    const ProgramResult result =
        run_program(box({"--quick", "--repetitions", "2", "--reference-spp", "1024", "--algorithms",
                         "path", "--budget", "1ms"}),
                    {.environment = {{"WEFT_OIDN_LIBRARY", WEFT_OIDN_STUB_2}}});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json found = report();
    std::map<std::string, json> points;
    for (const json& point : found["points"]) points[point["name"]] = point;
    ASSERT_EQ(points.size(), 5U);
    const auto error = [&](const char* name) {
        return points.at(name)["unbiased_relmse"]["value"].get<double>();
    };
    // In so small an image most of what is left lies at the border of the light, where nothing is
    // averaged: 0.051 of 0.074.
    EXPECT_LT(error("path statistical spp 16"), 0.8 * error("path spp 16"));
    // What stands in for the library takes half of the light, a fourth of its square.
    EXPECT_GT(error("path oidn spp 16"), error("path spp 16") / 4.0 + 0.05);
}

TEST_F(TradeoffCommand, ItsAdviceCanBeRendered) {
    ASSERT_EQ(run_program(box(small)).exit_code, 0);
    const json found = report();
    std::size_t with_settings = 0;
    for (const json& advice : found["advice"]) {
        if (advice["preset"].is_null()) continue;
        ++with_settings;
        const std::string file = at("out/" + advice["preset"].get<std::string>());
        const auto named =
            std::find_if(found["points"].begin(), found["points"].end(),
                         [&](const json& point) { return point["name"] == advice["point"]; });
        ASSERT_NE(named, found["points"].end());
        EXPECT_EQ(preset_json(read_preset(file)), (*named)["preset"]);
    }
    EXPECT_GE(with_settings, 1U);
    const ProgramResult rendered = run_program(
        {"render", shipped_scene("cornell-box.gltf"), "--preset", at("out/preset-60s.json"), "-o",
         at("picture.exr"), "--size", "32x24", "--backend", "native", "--progress", "none"});
    EXPECT_EQ(rendered.exit_code, 0) << rendered.err;
    EXPECT_EQ(read_exr(at("picture.exr")).width, 32U);
}

TEST_F(TradeoffCommand, KeepsTheReferenceAndChecksTheFront) {
    const std::vector<std::string> few{"--quick",   "--repetitions", "2",   "--reference-spp",
                                       "8",         "--algorithms",  "igi", "--verify",
                                       "--measure", "relmse"};
    ASSERT_EQ(run_program(box(few)).exit_code, 0);
    const json first = report();
    EXPECT_EQ(first["check"]["pictures"], 3);
    EXPECT_LE(first["check"]["times_within"], 3);
    EXPECT_EQ(first["check"]["points"][0]["ms"].size(), 3U);
    std::vector<fs::path> references;
    std::size_t sums = 0;
    for (const auto& entry : fs::directory_iterator(at("references"))) {
        if (entry.path().extension() == ".exr") references.push_back(entry.path());
        sums += entry.path().extension() == ".sums" ? 1 : 0;
    }
    ASSERT_EQ(references.size(), 1U);
    EXPECT_EQ(sums, 2U);
    const auto made = fs::last_write_time(references[0]);
    ASSERT_EQ(run_program(box(few)).exit_code, 0);
    EXPECT_EQ(fs::last_write_time(references[0]), made);
    // The same seeds give the same images, and so the same errors.
    const json second = report();
    EXPECT_EQ(first["points"][0]["errors"], second["points"][0]["errors"]);
    EXPECT_EQ(first["reference"], second["reference"]);
}

TEST_F(TradeoffCommand, ComparesImagesOfOthers) {
    const ProgramResult rendered = run_program(
        {"render", shipped_scene("cornell-box.gltf"), "--algorithm", "path", "--spp", "2", "-o",
         at("other.exr"), "--size", "32x24", "--backend", "native", "--progress", "none"});
    ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
    folder_.write("peers.json",
                  R"({"weft_peers": 1, "pictures": [{"name": "other", "budget_s": 0.3,
                      "seconds": 0.2, "picture": "other.exr"}], "notes": ["a note"]})");
    std::vector<std::string> arguments = box({"--quick", "--repetitions", "2", "--reference-spp",
                                              "8", "--algorithms", "igi", "--peers"});
    arguments.push_back(at("peers.json"));
    const ProgramResult result = run_program(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json found = report();
    ASSERT_EQ(found["peers"].size(), 1U);
    EXPECT_EQ(found["peers"][0]["name"], "other");
    EXPECT_GT(found["peers"][0]["errors"]["relmse"], 0.0);
    EXPECT_EQ(found["peer_notes"], json{"a note"});
}

TEST_F(TradeoffCommand, FailsWithOneLine) {
    EXPECT_EQ(run_program({"tradeoff", at("missing.gltf"), "-o", at("out")}).exit_code, 2);
    folder_.write("file", "");
    std::vector<std::string> arguments = box(small);
    arguments[3] = at("file");
    const ProgramResult onto_file = run_program(arguments);
    EXPECT_EQ(onto_file.exit_code, 5);
    EXPECT_NE(onto_file.err.find("is no folder"), std::string::npos) << onto_file.err;
}

TEST_F(TradeoffCommand, AnInterruptedReferenceIsKept) {
    std::vector<std::string> arguments = box({"--reference-spp", "1000000"});
    for (std::string& argument : arguments)
        if (argument == "none") argument = "plain";
    test::RunningProgram program(arguments);
    // The first line comes as the reference begins; a sample of all pixels takes milliseconds.
    ASSERT_TRUE(program.wait_for_lines(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    program.send(SIGINT);
    EXPECT_EQ(program.wait(), 130) << program.err();
    EXPECT_FALSE(fs::exists(at("out/tradeoff.json")));
    std::size_t sums = 0;
    for (const auto& entry : fs::directory_iterator(at("references")))
        sums += entry.path().extension() == ".sums" ? 1 : 0;
    EXPECT_EQ(sums, 2U) << program.err();
}

}  // namespace
}  // namespace weft::tradeoff_command_test
