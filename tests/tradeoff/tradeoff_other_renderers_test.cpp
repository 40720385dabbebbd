// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "image/exr.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

namespace weft::tradeoff_other_renderers_test {
namespace {

namespace fs = std::filesystem;
using test::ProgramResult;
using test::run_program;

/// Runs `weft tradeoff` on the shipped box with a file of images by others.
ProgramResult run_with_others(const TemporaryFolder& folder, const std::string& others) {
    const auto at = [&](const char* name) { return (folder.path() / name).string(); };
    return run_program({"tradeoff",
                        test::shipped_scene("cornell-box.gltf"),
                        "-o",
                        at("out"),
                        "--size",
                        "32x24",
                        "--references",
                        at("references"),
                        "--backend",
                        "native",
                        "--progress",
                        "none",
                        "--quick",
                        "--repetitions",
                        "2",
                        "--reference-spp",
                        "8",
                        "--algorithms",
                        "igi",
                        "--peers",
                        folder.write("peers.json", others)});
}

std::string others_of(const std::string& image) {
    return R"({"weft_peers": 1, "pictures": [{"name": "other", "budget_s": 1, "seconds": 1,
               "picture": ")" +
           image + "\"}]}";
}

TEST(TradeoffOtherRenderers, WhatIsWrongIsKnownBeforeAnythingIsRendered) {
    const TemporaryFolder folder;
    Image small{.width = 2, .height = 1, .layers = {}, .metadata = {}};
    small.layers.push_back({"", "RGB", std::vector<float>(6, 0.5F)});
    write_exr(folder.path() / "small.exr", small);
    const std::vector<std::pair<std::string, std::string>> cases{
        {"{", "peers.json:1: JSON syntax error"},
        {R"({"weft_peers": 2})", "peers.json#/weft_peers: is version 2, expected 1"},
        {others_of("missing.exr"), "peers.json#/pictures/0/picture: "},
        {others_of("small.exr"),
         "peers.json#/pictures/0/picture: names 'small.exr', which is of 2 x 1 pixels, expected "
         "32 x 24"}};
    for (const auto& [others, message] : cases) {
        const ProgramResult result = run_with_others(folder, others);
        EXPECT_EQ(result.exit_code, 2) << result.err;
        EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
        EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_FALSE(fs::exists(folder.path() / "references")) << "a reference was begun";
        EXPECT_TRUE(fs::is_empty(folder.path() / "out"));
    }
}

}  // namespace
}  // namespace weft::tradeoff_other_renderers_test
