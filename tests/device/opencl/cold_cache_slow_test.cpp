// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/exr.h"
#include "tests/testing/run_program.h"

namespace weft::cold_cache_slow_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::run_program;
using test::RunningProgram;
using test::text_of_file;

bool has_opencl() {
    const json devices = json::parse(run_program({"devices", "--json"}).out);
    return devices.at(0).at("backend") == "opencl";
}

/// Compiles every kernel, as nothing is in either cache: the program's own and the driver's.
TEST(ColdCacheSlow, TwoProgramsAtOnceBothSucceed) {
    if (!has_opencl()) GTEST_SKIP() << "there is no OpenCL device";
    const TemporaryFolder folder;
    const auto at = [&](const std::string& name) { return (folder.path() / name).string(); };
    fs::create_directories(at("pocl"));
    RunningProgram::Settings settings;
    settings.environment = {{"WEFT_CACHE_DIR", at("weft")}, {"POCL_CACHE_DIR", at("pocl")}};
    const auto arguments = [&](const std::string& name) {
        return std::vector<std::string>{"render",       test::shipped_scene("cornell-box.gltf"),
                                        "-o",           at(name + ".exr"),
                                        "--size",       "48x40",
                                        "--stats",      at(name + ".json"),
                                        "--backend",    "opencl",
                                        "--progress",   "none",
                                        "--components", "direct"};
    };
    // A trial of the driver is over; what it has compiled is removed again.
    ASSERT_EQ(run_program({"devices"}, settings).exit_code, 0);
    for (const auto& entry : fs::directory_iterator(at("weft")))
        if (entry.path().extension() == ".program") fs::remove(entry.path());
    RunningProgram first(arguments("a"), settings);
    RunningProgram second(arguments("b"), settings);
    EXPECT_EQ(first.wait(), 0) << first.err();
    EXPECT_EQ(second.wait(), 0) << second.err();
    const Image a = read_exr(at("a.exr"));
    const Image b = read_exr(at("b.exr"));
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (std::size_t layer = 0; layer < a.layers.size(); ++layer)
        EXPECT_EQ(a.layers[layer].values, b.layers[layer].values) << a.layers[layer].name;
    // Only whole programs and the times of their compilation are left, and a third run takes them.
    std::size_t entries = 0;
    for (const auto& entry : fs::directory_iterator(at("weft"))) {
        const std::string name = entry.path().filename().string();
        if (name == "drivers" || name.starts_with("compile-times-")) continue;
        EXPECT_EQ(entry.path().extension(), ".program") << entry.path();
        ++entries;
    }
    EXPECT_EQ(run_program(arguments("c"), settings).exit_code, 0);
    const json stats = json::parse(text_of_file(at("c.json")));
    EXPECT_EQ(stats.at("kernels").size(), entries);
    for (const json& kernel : stats["kernels"]) EXPECT_EQ(kernel.at("from_cache"), true) << kernel;
}

}  // namespace
}  // namespace weft::cold_cache_slow_test
