// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "image/exr.h"
#include "tests/testing/expect_line.h"
#include "tests/testing/run_program.h"
#include "tests/testing/vol_bytes.h"

namespace weft::program_test {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::run_program;
using test::RunningProgram;
using test::shipped_scene;
using test::text_of_file;

const std::string empty_scene = "<scene version=\"3.0.0\"></scene>\n";

/// One line of errors, and nothing else.
void expect_one_message(const ProgramResult& result) {
    test::expect_line(result.err);
    EXPECT_EQ(result.out, "");
}

TEST(Program, HelpAndVersionGoToStandardOutput) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"--help"}, {"render", "--help"}, {"info", "-h"}, {"devices", "--help"}}) {
        const ProgramResult result = run_program(arguments);
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_NE(result.out.find("weft"), std::string::npos);
        EXPECT_EQ(result.err, "");
    }
    EXPECT_TRUE(std::regex_match(run_program({"--version"}).out,
                                 std::regex("weft [0-9]+\\.[0-9]+\\.[0-9]+\n")));
}

TEST(Program, WrongUsageIsCodeOne) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{},
                                               {"rendr"},
                                               {"render"},
                                               {"render", "a.gltf", "--tiel", "3"},
                                               {"render", "a.gltf", "--size", "0x0"},
                                               {"render", "a.gltf", "-o", "image.jpg"},
                                               {"render", shipped_scene("cornell-box.gltf"),
                                                "--camera", "no such", "--progress", "none"},
                                               {"info"}}) {
        const ProgramResult result = run_program(arguments);
        EXPECT_EQ(result.exit_code, 1);
        expect_one_message(result);
    }
}

TEST(Program, BadInputIsCodeTwo) {
    const TemporaryFolder folder;
    const std::string damaged = folder.write("damaged.gltf", "{\"asset\":");
    const std::string odd = folder.write("scene.txt", "text");
    for (const std::string& scene : {std::string("no-such-file.gltf"), damaged, odd}) {
        for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
                 {"info", scene},
                 {"render", scene, "--progress", "none", "-o", folder.path() / "x.png"}}) {
            const ProgramResult result = run_program(arguments);
            EXPECT_EQ(result.exit_code, 2) << scene;
            expect_one_message(result);
            EXPECT_NE(result.err.find(scene), std::string::npos) << result.err;
        }
    }
    EXPECT_EQ(folder.entry_count(), 2u) << "something was left behind";
}

TEST(Program, UnknownDevicesAreCodeThree) {
    const TemporaryFolder folder;
    const ProgramResult result =
        run_program({"render", shipped_scene("cornell-box.gltf"), "--backend", "opencl", "--device",
                     "no such device", "--progress", "none", "-o", folder.path() / "x.png"});
    EXPECT_EQ(result.exit_code, 3);
    expect_one_message(result);
    EXPECT_EQ(folder.entry_count(), 0u);
}

TEST(Program, TheSelftestSaysWhyNoOpenClDeviceIsTested) {
    const TemporaryFolder folder;
    RunningProgram::Settings settings;
    settings.environment["OCL_ICD_VENDORS"] = folder.path();
    const ProgramResult result = run_program({"selftest", "--cases", "10"}, settings);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("no OpenCL device was found"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find(": native code alone\n"), std::string::npos) << result.out;
}

TEST(Program, DevicesAsJson) {
    const ProgramResult result = run_program({"devices", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json devices = json::parse(result.out);
    ASSERT_TRUE(devices.is_array());
    ASSERT_FALSE(devices.empty());
    for (const json& device : devices) {
        for (const char* key : {"index", "memory", "native_width"})
            EXPECT_TRUE(device.at(key).is_number_integer()) << key;
        for (const char* key : {"name", "backend", "driver"})
            EXPECT_TRUE(device.at(key).is_string()) << key;
        EXPECT_GT(device["memory"], 0);
        EXPECT_GE(device["native_width"], 1);
    }
    EXPECT_EQ(devices.back()["backend"], "embree");
    const ProgramResult text = run_program({"devices"});
    EXPECT_EQ(std::count(text.out.begin(), text.out.end(), '\n'),
              static_cast<std::ptrdiff_t>(devices.size()));
}

json info_of(const std::string& scene) {
    const ProgramResult result = run_program({"info", "--json", scene});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
}

bool holds(const json& list, const std::string& text) {
    return std::any_of(list.begin(), list.end(), [&](const json& entry) { return entry == text; });
}

TEST(Program, InfoAsJson) {
    const json info = info_of(shipped_scene("cornell-box.gltf"));
    for (const char* key : {"triangles", "lights", "media"})
        EXPECT_TRUE(info.at(key).is_number_integer()) << key;
    EXPECT_GT(info["triangles"], 0);
    EXPECT_EQ(info["lights"], 1);
    EXPECT_EQ(info["media"], 0);
    EXPECT_EQ(info["components"], json({"direct", "indirect"}));
    EXPECT_TRUE(holds(info["effects"], "area lights"));
    EXPECT_FALSE(holds(info["effects"], "textures"));
    EXPECT_TRUE(holds(info["kernels"], "vpl_gather"));
    EXPECT_TRUE(holds(info_of(shipped_scene("gallery.gltf"))["effects"], "textures"));
}

TEST(Program, InfoOfAnEmptySceneAndOfMedia) {
    const TemporaryFolder folder;
    const json empty = info_of(folder.write("empty.xml", empty_scene));
    EXPECT_EQ(empty["triangles"], 0);
    EXPECT_EQ(empty["lights"], 0);
    EXPECT_TRUE(empty["effects"].empty() && empty["components"].empty());
    EXPECT_FALSE(holds(empty["kernels"], "vpl_gather"));
    const json media = info_of(
        folder.write("media.xml",
                     "<scene version=\"3.0.0\">\n<shape type=\"cube\"><bsdf type=\"null\"/>"
                     "<medium name=\"interior\" type=\"homogeneous\"/></shape>\n</scene>\n"));
    EXPECT_EQ(media["media"], 1);
    EXPECT_EQ(media["medium_list"],
              json::array({"homogeneous (homogeneous, extinction 1, albedo 0.75, g 0)"}));
    EXPECT_EQ(media["triangles"], 0);  // the boundary is no surface
    folder.write("smoke.vol", vol_file({2, 1, 3}, {0, 1, 2, 3, 4, 5}));
    const json smoke = info_of(
        folder.write("smoke.xml",
                     "<scene version=\"3.0.0\">\n<shape type=\"cube\"><bsdf type=\"null\"/>"
                     "<medium name=\"interior\" type=\"heterogeneous\"><volume name=\"sigma_t\" "
                     "type=\"gridvolume\"><string name=\"filename\" value=\"smoke.vol\"/></volume>"
                     "</medium></shape>\n</scene>\n"));
    EXPECT_EQ(smoke["medium_list"],
              json::array({"heterogeneous (density grid of 2 x 1 x 3 voxels up to 5, extinction 1, "
                           "albedo 0.75, g 0)"}));
    const json effects = media["effects"];
    EXPECT_TRUE(std::any_of(effects.begin(), effects.end(), [](const json& effect) {
        return effect.get<std::string>().starts_with("participating media");
    }));
}

TEST(Program, AllAlgorithmsSimulateMedia) {
    const TemporaryFolder folder;
    const std::string scene = folder.write(
        "fog.xml",
        "<scene version=\"3.0.0\">\n<shape type=\"cube\"><bsdf type=\"null\"/>"
        "<medium name=\"interior\" type=\"homogeneous\"/></shape>\n"
        "<emitter type=\"constant\"/>\n"
        "<sensor type=\"perspective\"><transform name=\"to_world\"><lookat origin=\"0,0,4\" "
        "target=\"0,0,0\" up=\"0,1,0\"/></transform></sensor>\n</scene>\n");
    for (const std::string algorithm : {"igi", "ais", "path"}) {
        const ProgramResult result =
            run_program({"render", scene, "--size", "8x8", "--spp", "1", "--backend", "embree",
                         "--algorithm", algorithm, "-o", (folder.path() / "a.exr").string()});
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_EQ(result.err.find("media"), std::string::npos) << result.err;
        const Image image = read_exr(folder.path() / "a.exr");
        EXPECT_EQ(image.find("media") == nullptr, algorithm == "path");
    }
    const ProgramResult refused = run_program(
        {"render", scene, "--vpl-compensation", "-o", (folder.path() / "b.exr").string()});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_NE(refused.err.find("--vpl-compensation: knows nothing of participating media"),
              std::string::npos);
    const ProgramResult cached = run_program({"render", scene, "--algorithm", "irradiance-cache",
                                              "-o", (folder.path() / "c.exr").string()});
    EXPECT_EQ(cached.exit_code, 1);
    EXPECT_NE(cached.err.find("irradiance-cache knows nothing of participating media"),
              std::string::npos);
}

TEST(Program, NamesThatAreNotUtf8AreNoError) {
    const TemporaryFolder folder;
    const std::string scene = folder.write("b\xfc\xff.xml", empty_scene);
    EXPECT_TRUE(info_of(scene)["scene"].is_string());
    EXPECT_EQ(run_program({"info", scene}).exit_code, 0);
    const std::string stats = folder.path() / "s\xff.json";
    const ProgramResult result =
        run_program({"render", scene, "--size", "8x8", "--backend", "embree", "-o",
                     folder.path() / "p\xfe.png", "--stats", stats, "--progress", "none"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(json::parse(text_of_file(stats))["options"]["scene"].is_string());
}

TEST(Program, ResultsThatCannotBeWrittenAreCodeFive) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    RunningProgram::Settings settings;
    settings.standard_output = "/dev/full";
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"--help"},
             {"devices"},
             {"devices", "--json"},
             {"info", shipped_scene("cornell-box.gltf")},
             {"info", "--json", shipped_scene("cornell-box.gltf")}}) {
        const ProgramResult result = run_program(arguments, settings);
        EXPECT_EQ(result.exit_code, 5);
        expect_one_message(result);
    }
}

TEST(Program, AReaderThatHasGoneIsCodeFive) {
    int ends[2] = {-1, -1};
    ASSERT_EQ(::pipe(ends), 0);
    ::close(ends[0]);
    RunningProgram::Settings settings;
    settings.output_descriptor = ends[1];
    const ProgramResult result = run_program({"devices"}, settings);
    ::close(ends[1]);
    EXPECT_EQ(result.exit_code, 5);
    expect_one_message(result);
}

/// Long names of options, each at the start of a line of `text` that `pattern` describes.
std::set<std::string> options_in(const std::string& text, const std::string& pattern) {
    std::set<std::string> names;
    const std::regex line(pattern);
    for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it)
        names.insert((*it)[1]);
    return names;
}

/// What the page of options says of a command.
std::string documented_section(const std::string& command) {
    const std::string page = text_of_file(std::string(WEFT_SOURCE_DIR) + "/docs/options.md");
    const std::size_t begin = page.find("\n## Options of `weft " + command + "`\n");
    EXPECT_NE(begin, std::string::npos) << command;
    return begin == std::string::npos ? ""
                                      : page.substr(begin, page.find("\n## ", begin + 1) - begin);
}

TEST(Program, HelpAndDocumentationListTheSameOptions) {
    for (const std::string command : {"render", "tradeoff"}) {
        std::set<std::string> helped =
            options_in(run_program({command, "--help"}).out, "\n +(?:-\\w,)?(--[a-z-]+)");
        helped.erase("--help");
        std::set<std::string> documented =
            options_in(documented_section(command), "\n\\| (?:`-\\w`, )?`(--[a-z-]+)");
        // Those that are as of `render` are named in one sentence.
        if (command != "render")
            documented.merge(options_in(documented_section(command),
                                        "(?:\n|, | and )`(--[a-z-]+)`(?=,| and| are)"));
        EXPECT_GE(helped.size(), 15U);
        EXPECT_EQ(helped, documented) << command;
    }
}

}  // namespace
}  // namespace weft::program_test
