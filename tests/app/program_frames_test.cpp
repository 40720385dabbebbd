// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/exr.h"
#include "tests/testing/child_processes.h"
#include "tests/testing/gltf_builder.h"
#include "tests/testing/program_backends.h"
#include "tests/testing/run_program.h"

namespace weft::program_frames_test {
namespace {

using nlohmann::json;
using test::program_backends;
using test::ProgramResult;
using test::run_program;
using test::RunningProgram;
using test::shipped_scene;
using test::text_of_file;

/// The camera's x at the three keys, at 0, 1 and 2 s; exact as floats.
constexpr std::array<float, 3> places = {0.25F, 0.28125F, 0.3125F};

class ProgramFrames : public testing::Test {
  protected:
    ProgramFrames() {
        json box = json::parse(text_of_file(shipped_scene("cornell-box.gltf")));
        // As keys hold it.
        for (json& number : box["nodes"].back()["translation"])
            number = static_cast<double>(number.get<float>());
        folder_.write("moving.gltf", moving(box).dump());
        for (std::size_t i = 0; i < places.size(); ++i) {
            json still = box;
            still["nodes"].back()["translation"][0] = places[i];
            folder_.write("still" + std::to_string(i) + ".gltf", still.dump());
        }
    }

    /// The box with a camera that moves along x.
    static json moving(json box) {
        std::string bytes;
        const auto add = [&](float number) {
            char word[sizeof number];
            std::memcpy(word, &number, sizeof number);
            bytes.append(word, sizeof number);
        };
        for (const float time : {0.0F, 1.0F, 2.0F}) add(time);
        for (const float place : places)
            for (const int axis : {0, 1, 2})
                add(axis == 0 ? place : box["nodes"].back()["translation"][axis].get<float>());
        const std::size_t buffer = box["buffers"].size();
        const std::size_t view = box["bufferViews"].size();
        const std::size_t accessor = box["accessors"].size();
        box["buffers"].push_back(
            {{"byteLength", bytes.size()},
             {"uri", "data:application/octet-stream;base64," + encode_base64(bytes)}});
        box["bufferViews"].push_back({{"buffer", buffer}, {"byteLength", 12}});
        box["bufferViews"].push_back({{"buffer", buffer}, {"byteOffset", 12}, {"byteLength", 36}});
        for (const char* type : {"SCALAR", "VEC3"})
            box["accessors"].push_back({{"bufferView", *type == 'S' ? view : view + 1},
                                        {"componentType", 5126},
                                        {"type", type},
                                        {"count", 3}});
        const std::size_t camera = box["nodes"].size() - 1;
        box["animations"] = {
            {{"samplers", {{{"input", accessor}, {"output", accessor + 1}}}},
             {"channels",
              {{{"sampler", 0}, {"target", {{"node", camera}, {"path", "translation"}}}}}}}};
        return box;
    }

    [[nodiscard]] std::string at(const std::string& name) const { return folder_.path() / name; }

    [[nodiscard]] std::vector<std::string> command(const std::string& scene,
                                                   const std::string& output,
                                                   const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"render",   at(scene), "-o",
                                           at(output), "--size",  "32x24"};
        if (std::find(more.begin(), more.end(), "--progress") == more.end())
            arguments.insert(arguments.end(), {"--progress", "none"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    TemporaryFolder folder_;
};

bool same_values(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.layers.size() == b.layers.size() &&
           std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(),
                      [](const Layer& x, const Layer& y) {
                          return x.name == y.name && x.values == y.values;
                      });
}

TEST_F(ProgramFrames, EveryFrameIsTheImageFromThere) {
    for (const std::string& backend : program_backends())
        for (const std::string algorithm : {"igi", "path"}) {
            SCOPED_TRACE(backend + " " + algorithm);
            const std::vector<std::string> options{
                "--backend", backend,    "--algorithm", algorithm,      "--spp",
                "3",         "--frames", "0:3",         "--frame-rate", "1"};
            const ProgramResult result = run_program(command("moving.gltf", "out.exr", options));
            ASSERT_EQ(result.exit_code, 0) << result.err;
            EXPECT_EQ(result.err, "");
            std::vector<Image> frames;
            for (std::size_t i = 0; i < places.size(); ++i) {
                SCOPED_TRACE(i);
                const std::string number = std::to_string(i);
                frames.push_back(read_exr(at("out.000" + number + ".exr")));
                EXPECT_EQ(frames[i].metadata.at("samples"), "3");
                const std::vector<std::string> alone(options.begin(), options.begin() + 6);
                ASSERT_EQ(
                    run_program(command("still" + number + ".gltf", "alone.exr", alone)).exit_code,
                    0);
                EXPECT_TRUE(same_values(frames[i], read_exr(at("alone.exr"))));
            }
            EXPECT_FALSE(same_values(frames[0], frames[1]));
            EXPECT_FALSE(same_values(frames[1], frames[2]));
            std::filesystem::remove(at("alone.exr"));
            EXPECT_FALSE(std::filesystem::exists(at("out.exr")));
            EXPECT_FALSE(std::filesystem::exists(at("out.0003.exr")));
        }
}

TEST_F(ProgramFrames, OneFrameIsAnImageUnderItsOwnName) {
    for (const std::string algorithm : {"igi", "path"}) {
        SCOPED_TRACE(algorithm);
        const std::vector<std::string> options{"--backend", "native", "--algorithm",  algorithm,
                                               "--spp",     "3",      "--frame-rate", "1"};
        const auto with = [&](const std::string& name, const std::string& value) {
            std::vector<std::string> all = options;
            all.insert(all.end(), {name, value});
            return all;
        };
        ASSERT_EQ(run_program(command("moving.gltf", "out.exr", with("--frames", "1:2"))).exit_code,
                  0);
        const ProgramResult one =
            run_program(command("moving.gltf", "one.exr", with("--frame", "1")));
        ASSERT_EQ(one.exit_code, 0) << one.err;
        EXPECT_EQ(one.err, "");
        EXPECT_TRUE(same_values(read_exr(at("one.exr")), read_exr(at("out.0001.exr"))));
    }
    // It is refined and split in parts like any other single image.
    const ProgramResult parts =
        run_program(command("moving.gltf", "part.exr",
                            {"--backend", "native", "--algorithm", "path", "--frame", "2",
                             "--frame-rate", "1", "--samples", "2:4"}));
    EXPECT_EQ(parts.exit_code, 0) << parts.err;
}

TEST_F(ProgramFrames, OneFrameShowsItsEdits) {
    const std::string edits = std::filesystem::path(shipped_scene("cornell-box.gltf"))
                                  .replace_filename("cornell-box-edits.json");
    const std::vector<std::string> common{"--backend", "native", "--algorithm", "path",
                                          "--spp",     "4",      "--size",      "24x24",
                                          "--edits",   edits,    "--progress",  "none"};
    const auto run = [&](const std::string& output, const std::vector<std::string>& more) {
        std::vector<std::string> all{"render", shipped_scene("cornell-box.gltf"), "-o", at(output)};
        all.insert(all.end(), common.begin(), common.end());
        all.insert(all.end(), more.begin(), more.end());
        const ProgramResult result = run_program(all);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.err, "");
    };
    run("all.exr", {"--frames", "3:5"});
    run("three.exr", {"--frame", "3", "--stats", at("stats.json")});
    run("four.exr", {"--frame", "4"});
    EXPECT_TRUE(same_values(read_exr(at("three.exr")), read_exr(at("all.0003.exr"))));
    EXPECT_TRUE(same_values(read_exr(at("four.exr")), read_exr(at("all.0004.exr"))));
    EXPECT_FALSE(same_values(read_exr(at("three.exr")), read_exr(at("four.exr"))));
    const json stats = json::parse(text_of_file(at("stats.json")));
    EXPECT_EQ(stats.at("options").at("frame"), 3);
    for (const json& sample : stats.at("frames")) EXPECT_EQ(sample.at("frame"), 3);
}

TEST_F(ProgramFrames, PartsOfOneFrameAreNotThoseOfAnother) {
    const auto part = [&](const std::string& output, const char* frame, const char* samples) {
        const ProgramResult result =
            run_program(command("moving.gltf", output,
                                {"--backend", "native", "--algorithm", "path", "--frame", frame,
                                 "--frame-rate", "1", "--samples", samples}));
        EXPECT_EQ(result.exit_code, 0) << result.err;
    };
    part("a.exr", "1", "0:2");
    part("b.exr", "1", "2:4");
    part("c.exr", "2", "2:4");
    const auto merged = [&](const char* other) {
        return run_program({"merge", at("a.exr"), at(other), "-o", at("merged.exr")}).exit_code;
    };
    EXPECT_EQ(merged("c.exr"), 2);
    EXPECT_EQ(merged("b.exr"), 0);
    const ProgramResult whole =
        run_program(command("moving.gltf", "whole.exr",
                            {"--backend", "native", "--algorithm", "path", "--frame", "1",
                             "--frame-rate", "1", "--spp", "4"}));
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_EQ(read_exr(at("merged.exr")).find("")->values,
              read_exr(at("whole.exr")).find("")->values);
}

TEST_F(ProgramFrames, EditsMayStandInTheCommand) {
    const std::string edits = R"({"edits":[{"frame":0,"object":"short block","move":[0.1,0,0]}]})";
    folder_.write("edits.json", edits);
    const std::vector<std::string> options{"--backend", "native", "--spp",  "2",
                                           "--frame",   "0",      "--edits"};
    const auto with = [&](const std::string& value) {
        std::vector<std::string> all = options;
        all.push_back(value);
        return all;
    };
    ASSERT_EQ(run_program(command("moving.gltf", "file.exr", with(at("edits.json")))).exit_code, 0);
    ASSERT_EQ(run_program(command("moving.gltf", "text.exr", with(edits))).exit_code, 0);
    EXPECT_TRUE(same_values(read_exr(at("file.exr")), read_exr(at("text.exr"))));
    const ProgramResult bad = run_program(command("moving.gltf", "bad.exr", with("{\"edits\"")));
    EXPECT_EQ(bad.exit_code, 2);
    EXPECT_NE(bad.err.find("--edits"), std::string::npos) << bad.err;
}

TEST_F(ProgramFrames, FramesStandOnTheirOwn) {
    // Half a second is between two keys. Nothing depends on which frames were asked for.
    const std::vector<std::string> rate{"--backend",    "embree", "--algorithm", "igi",
                                        "--frame-rate", "2",      "--frames"};
    const auto run = [&](const std::string& output, const std::string& range) {
        std::vector<std::string> options = rate;
        options.push_back(range);
        const ProgramResult result = run_program(command("moving.gltf", output, options));
        EXPECT_EQ(result.exit_code, 0) << result.err;
    };
    run("all.png", "0:5");
    run("one.png", "3:4");
    EXPECT_TRUE(text_of_file(at("all.0003.png")) == text_of_file(at("one.0003.png")));
    EXPECT_FALSE(text_of_file(at("all.0003.png")) == text_of_file(at("all.0002.png")));
    run("end.png", "9999:10001");
    EXPECT_TRUE(text_of_file(at("end.9999.png")) == text_of_file(at("all.0004.png")));
    EXPECT_TRUE(text_of_file(at("end.10000.png")) == text_of_file(at("all.0004.png")));
    EXPECT_EQ(folder_.entry_count(), 4u + 5u + 1u + 2u) << "something else was left";
}

TEST_F(ProgramFrames, ThirtyFramesAreASecond) {
    const std::vector<std::string> options{"--backend", "embree", "--frames", "30:31"};
    ASSERT_EQ(run_program(command("moving.gltf", "out.exr", options)).exit_code, 0);
    // A single image would have settings that flicker in a sequence.
    const std::vector<std::string> alone{"--backend", "embree", "--frames", "0:1"};
    ASSERT_EQ(run_program(command("still1.gltf", "alone.exr", alone)).exit_code, 0);
    EXPECT_TRUE(same_values(read_exr(at("out.0030.exr")), read_exr(at("alone.0000.exr"))));
}

TEST_F(ProgramFrames, StatisticsHoldAllFrames) {
    const ProgramResult result =
        run_program(command("moving.gltf", "out.png",
                            {"--backend", "native", "--algorithm", "igi", "--spp", "2", "--frames",
                             "7:10", "--frame-rate", "12.5", "--stats", at("stats.json")}));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json stats = json::parse(text_of_file(at("stats.json")));
    std::vector<int> numbers;
    for (const json& frame : stats.at("frames")) numbers.push_back(frame.at("frame"));
    EXPECT_EQ(numbers, (std::vector<int>{7, 7, 8, 8, 9, 9}));
    EXPECT_EQ(stats.at("options").at("frames"), json({7, 10}));
    EXPECT_EQ(stats.at("options").at("frame_rate"), 12.5);
    EXPECT_EQ(stats.at("samples"), 2);
    EXPECT_EQ(stats.at("kernels").size(), 10u) << "kernels are built once";
}

TEST_F(ProgramFrames, TimeIsOfAllFrames) {
    const ProgramResult result = run_program(command(
        "moving.gltf", "out.png",
        {"--backend", "embree", "--frames", "0:3", "--time", "1ms", "--stats", at("stats.json")}));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json stats = json::parse(text_of_file(at("stats.json")));
    EXPECT_EQ(stats.at("frames").size(), 3u) << "each image has one sample in any case";
    EXPECT_TRUE(std::filesystem::exists(at("out.0002.png")));
}

TEST_F(ProgramFrames, AStillCameraGivesEqualFramesAndAWarning) {
    const ProgramResult result =
        run_program(command("still0.gltf", "out.png", {"--backend", "embree", "--frames", "0:2"}));
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.err.find(
                  "neither the scene nor camera 'camera' is animated, all frames are the same"),
              std::string::npos)
        << result.err;
    EXPECT_TRUE(text_of_file(at("out.0000.png")) == text_of_file(at("out.0001.png")));
    EXPECT_FALSE(text_of_file(at("out.0001.png")).empty());
    const ProgramResult one =
        run_program(command("still0.gltf", "one.png", {"--backend", "embree", "--frame", "1"}));
    EXPECT_EQ(one.exit_code, 0);
    EXPECT_NE(one.err.find("neither the scene nor camera 'camera' is animated, the image is that "
                           "of every frame"),
              std::string::npos)
        << one.err;
}

TEST_F(ProgramFrames, WithoutFramesTheSceneIsAtRest) {
    ASSERT_EQ(run_program(command("moving.gltf", "rest.png", {"--backend", "embree"})).exit_code,
              0);
    EXPECT_TRUE(std::filesystem::exists(at("rest.png")));
    EXPECT_FALSE(std::filesystem::exists(at("rest.0000.png")));
}

TEST_F(ProgramFrames, InterruptionKeepsTheFinishedImages) {
    RunningProgram program(command(
        "moving.gltf", "out.png",
        {"--backend", "embree", "--spp", "20", "--frames", "0:100000", "--progress", "plain"}));
    ASSERT_TRUE(test::comes_true([&] { return std::filesystem::exists(at("out.0001.png")); }))
        << program.err();
    program.send(SIGINT);
    EXPECT_EQ(program.wait(), 130);
    std::size_t finished = 0;
    while (std::filesystem::exists(at("out." +
                                      std::string(finished < 10     ? "000"
                                                  : finished < 100  ? "00"
                                                  : finished < 1000 ? "0"
                                                                    : "") +
                                      std::to_string(finished) + ".png")))
        ++finished;
    EXPECT_NE(program.err().find("interrupted, " + std::to_string(finished) +
                                 " of 100000 images are finished"),
              std::string::npos)
        << program.err();
    EXPECT_EQ(folder_.entry_count(), 4u + finished) << "something else was left";
}

TEST_F(ProgramFrames, ACameraThatVanishesLaterIsRefusedAtOnce) {
    json scene = json::parse(text_of_file(at("moving.gltf")));
    scene["animations"][0]["channels"][0]["target"]["path"] = "scale";
    json ones = scene["accessors"].back();
    ones["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", scene["bufferViews"].size()}, {"componentType", 5121}}},
        {"values", {{"bufferView", ones["bufferView"]}}}};
    ones.erase("bufferView");  // what is not listed is zero: the scale at the last key
    scene["bufferViews"].push_back({{"buffer", scene["buffers"].size()}, {"byteLength", 2}});
    scene["buffers"].push_back({{"byteLength", 2}, {"uri", "data:;base64,AAE="}});
    scene["accessors"].back() = ones;
    folder_.write("vanishing.gltf", scene.dump());
    const auto run = [&](const char* range) {
        return run_program(
            command("vanishing.gltf", "out.png",
                    {"--backend", "embree", "--frame-rate", "1", "--frames", range}));
    };
    const ProgramResult result = run("0:3");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, "weft: " + at("vanishing.gltf") +
                              ": camera 'camera' at 2 s has a transform that cannot be inverted\n");
    EXPECT_EQ(folder_.entry_count(), 5u) << "an image was written";
    EXPECT_EQ(run("0:2").exit_code, 0);
}

TEST_F(ProgramFrames, ImpossibleOptionsAreUsageErrors) {
    struct Case {
        std::vector<std::string> options;
        std::string message;
    };
    const std::vector<Case> cases = {
        {{"--frames", "3"}, "--frames: '3' is not valid, expected A:B, such as 0:30"},
        {{"--frames", "3:3"}, "--frames: '3:3' is not valid"},
        {{"--frames", "-1:3"}, "--frames: '-1:3' is not valid"},
        {{"--frames", "0:99999999"}, "--frames: '0:99999999' is not valid"},
        {{"--frames", "0:3", "--frame-rate", "0"}, "--frame-rate: '0' is not valid"},
        {{"--frames", "0:3", "--frame-rate", "1001"}, "--frame-rate: '1001' is not valid"},
        {{"--frame-rate", "25"}, "--frame-rate: is for animations, expected it together with"},
        {{"--frame", "-1"}, "--frame: '-1' is not valid"},
        {{"--frame", "16777216"}, "--frame: '16777216' is not valid"},
        {{"--frame", "1", "--frames", "0:3"}, "--frame: is one image instead of those of --frames"},
        {{"--frames", "0:3", "--algorithm", "path", "--samples", "0:4"},
         "--samples: is for a single image, expected it without --frames"},
        {{"--frames", "0:3", "--algorithm", "path", "--resume", at("sums.exr")},
         "--resume: is for a single image, expected it without --frames"},
        {{"--frames", "0:3", "--stats", at("out.0001.exr")},
         "--stats: names the same file as one of the images of --frames"},
    };
    for (const Case& wrong : cases) {
        const ProgramResult result = run_program(command("moving.gltf", "out.exr", wrong.options));
        EXPECT_EQ(result.exit_code, 1) << wrong.message;
        EXPECT_NE(result.err.find(wrong.message), std::string::npos) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
    EXPECT_EQ(folder_.entry_count(), 4u) << "something was written";
}

}  // namespace
}  // namespace weft::program_frames_test
