// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/exr.h"
#include "tests/testing/program_backends.h"
#include "tests/testing/run_program.h"

namespace weft::program_render_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::program_backends;
using test::ProgramResult;
using test::run_program;
using test::RunningProgram;
using test::shipped_scene;
using test::text_of_file;

class ProgramRender : public testing::Test {
  protected:
    [[nodiscard]] std::string at(const std::string& name) const { return folder_.path() / name; }

    /// Arguments of a small image of the shipped box, written to `output`.
    [[nodiscard]] std::vector<std::string> box(const std::string& output,
                                               const std::vector<std::string>& more = {},
                                               const std::string& size = "48x40") const {
        std::vector<std::string> arguments{
            "render", shipped_scene("cornell-box.gltf"), "-o", at(output), "--size", size};
        if (std::find(more.begin(), more.end(), "--progress") == more.end())
            arguments.insert(arguments.end(), {"--progress", "none"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    /// Runs with `--stats` and returns them.
    [[nodiscard]] json stats_of(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--stats", at("stats.json")});
        const ProgramResult result = run_program(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return json::parse(text_of_file(at("stats.json")));
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

double mean(const Layer& layer) {
    double sum = 0.0;
    for (const float v : layer.values) sum += static_cast<double>(v);
    return sum / static_cast<double>(layer.values.size());
}

TEST_F(ProgramRender, WritesImagesOnEveryBackend) {
    for (const std::string& backend : program_backends()) {
        SCOPED_TRACE(backend);
        const ProgramResult exr = run_program(box(backend + ".exr", {"--backend", backend}));
        EXPECT_EQ(exr.exit_code, 0);
        EXPECT_EQ(exr.err, "");
        EXPECT_EQ(exr.out, "");
        const Image image = read_exr(at(backend + ".exr"));
        EXPECT_EQ(image.width, 48u);
        EXPECT_EQ(image.height, 40u);
        EXPECT_EQ(image.metadata.at("samples"), "6");
        for (const char* layer : {"", "direct", "indirect", "albedo", "normal", "depth"}) {
            ASSERT_NE(image.find(layer), nullptr) << layer;
            EXPECT_GT(std::abs(mean(*image.find(layer))), 1e-4) << layer;
        }
        EXPECT_EQ(run_program(box(backend + ".PNG", {"--backend", backend})).exit_code, 0);
        EXPECT_TRUE(text_of_file(at(backend + ".PNG")).starts_with("\x89PNG\r\n\x1a\n"));
    }
    EXPECT_EQ(folder_.entry_count(), 2 * program_backends().size()) << "something was left behind";
}

// The libraries that run the threads have words of their own for too many.
TEST_F(ProgramRender, UsesNoMoreThreadsThanThereAreProcessors) {
    for (const std::string& backend : program_backends()) {
        SCOPED_TRACE(backend);
        const json all = stats_of(box("x.png", {"--backend", backend}));
        for (const char* threads : {"4096", "1000"}) {
            const ProgramResult result =
                run_program(box("x.png", {"--backend", backend, "--threads", threads, "--stats",
                                          at("stats.json")}));
            EXPECT_EQ(result.exit_code, 0);
            EXPECT_EQ(result.err, "");
            EXPECT_EQ(json::parse(text_of_file(at("stats.json"))).at("options").at("threads"),
                      all.at("options").at("threads"));
        }
    }
}

TEST_F(ProgramRender, StatisticsHaveTheirKeys) {
    for (const std::string& backend : program_backends()) {
        SCOPED_TRACE(backend);
        const json stats =
            stats_of(box("x.png", {"--backend", backend, "--algorithm", "igi", "--spp", "2"}));
        EXPECT_EQ(stats.at("backend"), backend);
        EXPECT_EQ(stats.at("device").at("backend"), backend);
        EXPECT_TRUE(stats.at("nonfinite").empty());
        ASSERT_EQ(stats.at("frames").size(), 2u);
        std::uint64_t rays = 0;
        for (const json& frame : stats["frames"]) {
            EXPECT_GT(frame.at("ms"), 0.0);
            for (const char* component : {"emission", "direct", "indirect"})
                EXPECT_EQ(frame.at("nonfinite").at(component), 0) << component;
            rays = 0;
            for (const json& stage : frame.at("stages")) {
                EXPECT_TRUE(stage.at("name").is_string() && stage.at("component").is_string());
                EXPECT_GE(stage.at("ms"), 0.0);
                rays += stage.at("rays").get<std::uint64_t>();
            }
            EXPECT_EQ(frame.at("rays"), rays);
        }
        EXPECT_GE(rays, 48u * 40u);
        std::vector<std::string> names;
        for (const json& kernel : stats.at("kernels")) {
            names.push_back(kernel.at("name"));
            EXPECT_GE(kernel.at("build_ms"), 0.0);
            EXPECT_TRUE(kernel.at("flags").is_string());
        }
        EXPECT_EQ(names, (std::vector<std::string>{"gbuffer", "vpl_walk", "vpl_tail", "vpl_bounds",
                                                   "light_samples", "receivers", "vpl_gather",
                                                   "area_lights", "reconstruct", "compose"}));
    }
}

TEST_F(ProgramRender, StatisticsShowWhatOptionsCameTo) {
    const json chosen = stats_of(box("x.png", {"--backend", "embree"}))["options"];
    for (const auto& [name, value] : chosen.items()) {
        const bool has_no_default =
            name == "time" || name == "frame_time" || name == "samples" || name == "target_error" ||
            name == "resume" || name == "frames" || name == "frame" || name == "edits" ||
            name == "cache_records" || name == "cache_rays" || name == "cache_error" ||
            name == "preset" || name == "background" || name == "max_bounces" || name == "light" ||
            name == "environment" || name == "look_from" || name == "look_at" || name == "up" ||
            name == "fov" || name == "tev";
        EXPECT_EQ(value.is_null(), has_no_default) << name;
    }
    EXPECT_EQ(chosen.at("algorithm"), "ais");
    EXPECT_EQ(chosen.at("size"), json({48, 40}));
    EXPECT_EQ(chosen.at("backend"), "embree");
    EXPECT_EQ(chosen.at("camera"), "camera");
    EXPECT_EQ(chosen.at("components"), json({"direct", "indirect"}));
    EXPECT_EQ(chosen.at("spp"), 6);
    EXPECT_EQ(chosen.at("indirect"), "vpl");
    EXPECT_GE(chosen.at("threads"), 1);
    const json given = stats_of(
        box("x.png", {"--backend", "native", "--threads", "1", "--spp", "3", "--seed", "9",
                      "--components", "indirect", "--tile", "17", "--algorithm", "ir"}))["options"];
    EXPECT_EQ(given.at("backend"), "native");
    EXPECT_EQ(given.at("threads"), 1);
    EXPECT_EQ(given.at("spp"), 3);
    EXPECT_EQ(given.at("seed"), 9);
    EXPECT_EQ(given.at("components"), json({"indirect"}));
    EXPECT_EQ(given.at("tile"), 17);
    EXPECT_EQ(given.at("algorithm"), "ir");
}

TEST_F(ProgramRender, OnlyWhatIsNeededIsBuilt) {
    const auto kernels_of = [&](const std::vector<std::string>& more) {
        std::vector<std::string> names;
        std::vector<std::string> all{"--algorithm", "igi"};
        all.insert(all.end(), more.begin(), more.end());
        const json stats = stats_of(box("x.exr", all));
        for (const json& kernel : stats["kernels"]) names.push_back(kernel["name"]);
        return names;
    };
    for (const std::string& backend : program_backends()) {
        EXPECT_EQ(kernels_of({"--backend", backend, "--components", "direct"}),
                  (std::vector<std::string>{"gbuffer", "light_samples", "receivers", "area_lights",
                                            "reconstruct", "compose"}));
        const Image direct = read_exr(at("x.exr"));
        EXPECT_EQ(mean(*direct.find("indirect")), 0.0);
        EXPECT_GT(mean(*direct.find("direct")), 0.0);
        EXPECT_EQ(kernels_of({"--backend", backend, "--components", "indirect"}),
                  (std::vector<std::string>{"gbuffer", "vpl_walk", "vpl_tail", "vpl_bounds",
                                            "receivers", "vpl_gather", "reconstruct", "compose"}));
        const Image indirect = read_exr(at("x.exr"));
        EXPECT_EQ(mean(*indirect.find("direct")), 0.0);
        EXPECT_GT(mean(*indirect.find("indirect")), 0.0);
    }
}

TEST_F(ProgramRender, InfoListsWhatIsBuiltWhereNothingElseIsAskedFor) {
    for (const char* scene : {"cornell-box.gltf", "gallery.gltf"}) {
        SCOPED_TRACE(scene);
        const json info = json::parse(run_program({"info", "--json", shipped_scene(scene)}).out);
        const json stats = stats_of({"render", shipped_scene(scene), "-o", at("x.png"), "--size",
                                     "16x16", "--backend", "native", "--progress", "none"});
        json built = json::array();
        for (const json& kernel : stats["kernels"]) built.push_back(kernel["name"]);
        EXPECT_EQ(info["kernels"], built);
        EXPECT_EQ(info["components"], stats["options"]["components"]);
        // Adaptive sampling decides by tiles.
        for (const char* kernel : {"tile_geometry", "lattice_signal"})
            EXPECT_NE(std::find(built.begin(), built.end(), kernel), built.end()) << kernel;
    }
}

TEST_F(ProgramRender, ScenesWithoutTexturesBuildNoTextureCode) {
    if (program_backends().back() != "opencl") GTEST_SKIP() << "there is no OpenCL device";
    const auto features_of = [](const json& kernel) {
        const std::string flags = kernel["flags"];
        const std::string name = "-DWEFT_FEATURES=";
        const std::size_t at = flags.find(name);
        return at == std::string::npos ? 0xFFFFFFFFUL : std::stoul(flags.substr(at + name.size()));
    };
    const json plain = stats_of(box("x.png", {"--backend", "opencl"}));
    const ProgramResult info = run_program({"info", "--json", shipped_scene("cornell-box.gltf")});
    EXPECT_EQ(plain["kernels"].size(), json::parse(info.out)["kernels"].size());
    for (const json& kernel : plain["kernels"]) EXPECT_EQ(features_of(kernel) & 1UL, 0u) << kernel;
    bool textured = false;
    const json gallery =
        stats_of({"render", shipped_scene("gallery.gltf"), "-o", at("x.png"), "--size", "16x16",
                  "--backend", "opencl", "--progress", "none", "--components", "direct"});
    for (const json& kernel : gallery["kernels"])
        textured = textured || (features_of(kernel) & 1UL) != 0;
    EXPECT_TRUE(textured);
}

TEST_F(ProgramRender, ThreadsAndTilesChangeNothing) {
    for (const std::string& backend : program_backends())
        for (const std::string algorithm : {"ais", "igi"}) {
            SCOPED_TRACE(backend + " " + algorithm);
            const auto image = [&](const std::vector<std::string>& more) {
                std::vector<std::string> all{"--backend", backend, "--algorithm",
                                             algorithm,   "--spp", "2"};
                all.insert(all.end(), more.begin(), more.end());
                EXPECT_EQ(run_program(box("x.exr", all)).exit_code, 0);
                return read_exr(at("x.exr"));
            };
            const Image one = image({"--threads", "1"});
            EXPECT_TRUE(same_values(image({"--threads", "2"}), one));
            EXPECT_TRUE(same_values(image({"--tile", "7"}), one));
            EXPECT_FALSE(same_values(image({"--seed", "1"}), one));
        }
}

TEST_F(ProgramRender, MissingFoldersAreCodeFive) {
    for (const std::vector<std::string>& arguments :
         {box("missing/x.png"), box("missing/x.exr"),
          box("x.png", {"--stats", at("missing/x.json")})}) {
        const ProgramResult result = run_program(arguments);
        EXPECT_EQ(result.exit_code, 5);
        EXPECT_NE(result.err.find(at("missing")), std::string::npos) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(folder_.entry_count(), 0u) << "something was left behind";
    }
}

TEST_F(ProgramRender, AFolderInPlaceOfTheImageIsCodeFive) {
    fs::create_directories(at("x.png/inside"));
    const ProgramResult result = run_program(box("x.png", {"--backend", "embree"}, "8x8"));
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(folder_.entry_count(), 1u);
}

TEST_F(ProgramRender, CtrlCKeepsTheImage) {
    for (const std::string& backend : program_backends()) {
        SCOPED_TRACE(backend);
        // The first progress line comes at the start, the next one a second later: before any
        // sample, and, with kernels that are built by then, after the first ones.
        for (const int lines : {1, 2}) {
            RunningProgram program(
                box("x.exr", {"--backend", backend, "--spp", "100000", "--progress", "plain"}));
            ASSERT_TRUE(program.wait_for_lines(lines)) << program.err();
            program.send(SIGINT);
            ASSERT_EQ(program.wait(), 130) << program.err();
            if (program.err().find("no image is written") != std::string::npos) {
                EXPECT_EQ(folder_.entry_count(), 0u) << "something was left behind";
                EXPECT_EQ(lines, 1) << "there was time for samples";
                continue;
            }
            const Image image = read_exr(at("x.exr"));
            EXPECT_EQ(image.width, 48u);
            const int samples = std::stoi(image.metadata.at("samples"));
            EXPECT_GE(samples, 1);
            EXPECT_LT(samples, 100000);
            for (const Layer& layer : image.layers)
                for (const float v : layer.values) ASSERT_TRUE(std::isfinite(v)) << layer.name;
            // What a sample is built on is there in any case.
            EXPECT_GT(mean(*image.find("albedo")), 0.1);
            EXPECT_GT(mean(*image.find("depth")), 0.1);
            fs::remove(at("x.exr"));
            EXPECT_EQ(folder_.entry_count(), 0u) << "something was left behind";
        }
    }
}

TEST_F(ProgramRender, CtrlCBeforeTheFirstSampleKeepsTheEarlierImage) {
    std::ofstream(at("x.exr")) << "an earlier image";
    // Reading it takes much longer than a signal to arrive.
    std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 1'000'000; ++i) mesh += "f 1 2 3\n";
    std::ofstream(at("large.obj")) << mesh;
    for (const int signal : {SIGINT, SIGTERM})
        for (const char* algorithm : {"path", "ais"}) {
            RunningProgram program({"render", at("large.obj"), "-o", at("x.exr"), "--size", "8x8",
                                    "--algorithm", algorithm, "--backend", "embree", "--progress",
                                    "plain", "--stats", at("stats.json")});
            ASSERT_TRUE(program.wait_for_lines(1)) << program.err();
            program.send(signal);
            ASSERT_EQ(program.wait(), 130) << program.err();
            EXPECT_EQ(text_of_file(at("x.exr")), "an earlier image");
            EXPECT_NE(program.err().find("no image is written"), std::string::npos)
                << program.err();
            const std::string lines = program.err();
            EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2)
                << "something else was begun: " << lines;
            EXPECT_EQ(folder_.entry_count(), 2U) << "something was left behind";
        }
}

TEST_F(ProgramRender, TerminationKeepsTheImageAndStatistics) {
    RunningProgram program(box("x.exr", {"--backend", "embree", "--spp", "100000", "--progress",
                                         "plain", "--stats", at("stats.json")}));
    ASSERT_TRUE(program.wait_for_lines(2)) << program.err();
    program.send(SIGTERM);
    EXPECT_EQ(program.wait(), 130);
    const json stats = json::parse(text_of_file(at("stats.json")));
    EXPECT_EQ(std::to_string(stats["samples"].get<int>()),
              read_exr(at("x.exr")).metadata.at("samples"));
    EXPECT_EQ(stats["options"]["spp"], 100000);
}

TEST_F(ProgramRender, TimeEndsTheWork) {
    const json stats = stats_of(box("x.exr", {"--backend", "embree", "--time", "1s"}));
    const int samples = stats["samples"];
    EXPECT_GE(samples, 1);
    EXPECT_EQ(std::to_string(samples), read_exr(at("x.exr")).metadata.at("samples"));
    EXPECT_EQ(stats["options"]["time"], 1.0);
    EXPECT_EQ(stats["options"]["spp"], samples);
    // The first sample is finished however short the time.
    EXPECT_EQ(stats_of(box("x.exr", {"--backend", "embree", "--time", "1ms"}))["samples"], 1);
    EXPECT_GT(mean(*read_exr(at("x.exr")).find("indirect")), 0.0);
}

TEST_F(ProgramRender, RelativePathsAreOfTheWorkingFolder) {
    fs::create_directories(at("work"));
    for (const char* file :
         {"gallery.gltf", "gallery.bin", "gallery-tiles.png", "gallery-mosaic.png"})
        fs::copy(shipped_scene(file), at(file));
    RunningProgram::Settings settings;
    settings.working_folder = at("work");
    const ProgramResult result =
        run_program({"render", "../gallery.gltf", "--size", "16x16", "--backend", "embree",
                     "--progress", "none", "--components", "direct"},
                    settings);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_exr(at("work/gallery.exr")).width, 16u);
}

}  // namespace
}  // namespace weft::program_render_test
