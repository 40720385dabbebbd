// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/exr.h"
#include "tests/testing/render_fixture.h"
#include "tests/testing/room_scenes.h"
#include "tests/testing/run_program.h"

// Frame times that no machine keeps, or that every machine does: then gains are known.
namespace weft::frame_time_test {
namespace {

using nlohmann::json;
using test::room_with_ball;
using test::run_program;
using test::TestBackend;

constexpr double out_of_reach_ms = 1e-9;
constexpr double ample_ms = 1e12;

Camera camera() {
    return test::look_at({0.3, 0.1, 0.95}, {-0.1, -0.1, 0.0}, 1.2);
}

RenderSettings settings(double frame_time_ms) {
    RenderSettings small = test::small_settings(Algorithm::ais, 85, 67);
    small.sampling.vpls_per_set = 16;
    small.sampling.candidates = 1;  // as images that have a frame time
    small.sampling.threshold = 8.0;
    small.frame_time_ms = frame_time_ms;
    return small;
}

/// Levels of the indirect light in each image of a sequence with a still camera.
std::vector<LevelStats> sequence(double frame_time_ms, int images) {
    Renderer renderer(test::shared_executor(TestBackend::embree), room_with_ball(), camera(),
                      settings(frame_time_ms));
    std::vector<LevelStats> levels;
    for (int image = 0; image < images; ++image) {
        if (image > 0) renderer.move_camera(camera());
        EXPECT_TRUE(renderer.render_frame({}));
        for (const LevelStats& level : renderer.stats().back().levels)
            if (level.component == "indirect") levels.push_back(level);
    }
    EXPECT_EQ(levels.size(), static_cast<std::size_t>(images));
    return levels;
}

TEST(FrameTime, WithoutOneAllGainsStayOne) {
    for (const LevelStats& level : sequence(0.0, 4)) EXPECT_EQ(level.gain, 1.0);
}

TEST(FrameTime, OneThatCannotBeKeptMakesFramesCheap) {
    const std::vector<LevelStats> levels = sequence(out_of_reach_ms, 48);
    // Levels that are held or fade hide it for some images; in the end nothing is raised by its
    // error.
    for (std::size_t i = 1; i < levels.size(); ++i) {
        EXPECT_LE(levels[i].samples, levels[i - 1].samples) << i;
        EXPECT_GE(levels[i].gain, levels[i - 1].gain) << i;
    }
    for (int i = 0; i < 5; ++i)
        EXPECT_NEAR(levels[static_cast<std::size_t>(i)].gain, std::pow(1.25, i), 1e-9) << i;
    EXPECT_LT(2 * levels.back().samples, levels.front().samples);
}

TEST(FrameTime, AnAmpleOneMakesFramesDense) {
    const std::vector<LevelStats> levels = sequence(ample_ms, 24);
    // Once every tile is full there is nothing to spend time on.
    double gain = 1.0;
    for (std::size_t i = 1; i < levels.size(); ++i) {
        EXPECT_GE(levels[i].samples, levels[i - 1].samples) << i;
        if (levels[i - 1].tiles[0] + levels[i - 1].tiles[1] > 0)
            gain = std::max(0.8 * gain, 1.0 / 16.0);
        EXPECT_NEAR(levels[i].gain, gain, 1e-9) << i;
    }
    EXPECT_LT(gain, 0.5);
    EXPECT_GT(levels.back().samples, levels.front().samples);
}

TEST(FrameTime, AppliesToTheFramesOfOneImage) {
    RenderSettings progressive = settings(ample_ms);
    progressive.samples = 5;
    Renderer renderer(test::shared_executor(TestBackend::embree), room_with_ball(), camera(),
                      progressive);
    for (int frame = 0; frame < 5; ++frame) EXPECT_TRUE(renderer.render_frame({}));
    for (std::size_t i = 0; i < 5; ++i)
        for (const LevelStats& level : renderer.stats()[i].levels)
            EXPECT_NEAR(level.gain, std::pow(0.8, i), 1e-9) << level.component;
}

TEST(FrameTime, IsInTheStatistics) {
    const TemporaryFolder folder;
    const std::string stats = folder.path() / "stats.json";
    const std::string output = folder.path() / "out.exr";
    const auto result = run_program({"render",       test::shipped_scene("gallery.gltf"),
                                     "--algorithm",  "ais",
                                     "--quality",    "high",
                                     "--backend",    "embree",
                                     "--size",       "64x64",
                                     "--spp",        "3",
                                     "--frame-time", "2m",
                                     "--stats",      stats,
                                     "--progress",   "none",
                                     "-o",           output});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json found = json::parse(test::text_of_file(stats));
    EXPECT_EQ(found.at("options").at("frame_time"), 120.0);
    for (std::size_t i = 0; i < 3; ++i)
        for (const char* component : {"direct", "indirect"})
            EXPECT_NEAR(found.at("frames")[i].at("levels").at(component).at("gain").get<double>(),
                        std::pow(0.8, i), 1e-9)
                << component;
}

TEST(FrameTime, IsRefusedWhereNothingAdapts) {
    for (const char* algorithm : {"igi", "amax", "ir", "path"}) {
        const auto result =
            run_program({"render", "none.gltf", "--algorithm", algorithm, "--frame-time", "40ms"});
        EXPECT_EQ(result.exit_code, 1) << algorithm;
        EXPECT_EQ(result.err,
                  "weft: --frame-time: is for adaptive sampling, expected --algorithm ais\n");
    }
}

}  // namespace
}  // namespace weft::frame_time_test
