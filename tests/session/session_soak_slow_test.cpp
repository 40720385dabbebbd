// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/load/load_scene.h"
#include "tests/testing/run_program.h"
#include "tests/testing/session_fixture.h"

// Many images in one process, of changing scenes, sizes and algorithms: nothing may be left of
// those that are gone. Two rounds of two scenes find leaks of more than 50 kB an image;
// WEFT_SOAK_RENDERS asks for more images, and all scenes.
namespace weft::session_soak_slow_test {
namespace {

namespace fs = std::filesystem;
using test::TestBackend;

constexpr std::array scenes{"cornell-box.gltf", "cornell-box-fog.gltf", "car-paint.gltf",
                            "shirley6.gltf", "desk.gltf"};

/// What the process holds.
struct Holdings {
    double kib = 0.0;            ///< resident memory
    std::ptrdiff_t handles = 0;  ///< open files
    std::ptrdiff_t threads = 0;

    static Holdings now() {
        ::malloc_trim(0);
        Holdings holdings;
        std::ifstream status("/proc/self/status");
        for (std::string word; status >> word;)
            if (word == "VmRSS:") status >> holdings.kib;
        holdings.handles = std::distance(fs::directory_iterator("/proc/self/fd"), {});
        holdings.threads = std::distance(fs::directory_iterator("/proc/self/task"), {});
        return holdings;
    }
};

std::vector<ImageSettings> settings_of(std::uint32_t width, std::uint32_t height) {
    std::vector<ImageSettings> all;
    for (const Algorithm algorithm :
         {Algorithm::ais, Algorithm::amax, Algorithm::igi, Algorithm::ic, Algorithm::tic})
        all.emplace_back(test::small_settings(algorithm, width, height));
    all.emplace_back(test::small_path(width, height, 2));
    return all;
}

/// Renders a scene on a device of its own in several sizes by several algorithms; returns how many
/// images that were.
int render_all(const char* name, TestBackend backend) {
    Diagnostics diagnostics;
    Scene scene = load_scene(test::shipped_scene(name), diagnostics);
    const Camera camera = scene.cameras.at(0);
    int images = 0;
    RenderSession session(test::make_executor(backend), MovingScene(std::move(scene), {}, 30.0),
                          camera, settings_of(24, 18).front(), 16);
    for (const auto& [width, height] : {std::pair{48U, 36U}, {97U, 61U}})
        for (const ImageSettings& settings : settings_of(width, height)) {
            session.set_settings(settings);
            EXPECT_EQ(session.render({}), SessionEnd::complete);
            EXPECT_EQ(session.image().image.width, width);
            ++images;
        }
    return images;
}

TEST(SessionSoakSlow, NothingIsLeftOfImagesThatAreGone) {
    if (std::getenv("WEFT_SANITIZED") != nullptr) GTEST_SKIP() << "sanitizers keep what is freed";
    const char* const wanted = std::getenv("WEFT_SOAK_RENDERS");
    const int least = wanted != nullptr ? std::atoi(wanted) : 0;
    const auto rendered = std::span(scenes).first(wanted != nullptr ? scenes.size() : 2);
    std::vector<TestBackend> backends{TestBackend::own_bvh, TestBackend::embree};
    if (test::has_opencl()) backends.push_back(TestBackend::opencl);
    int images = 0;
    // The first round fills caches that are meant to stay: pools of memory, threads, and what
    // drivers keep of kernels.
    Holdings first;
    Holdings last;
    for (int round = 0; images < least || round < 2; ++round) {
        for (const TestBackend backend : backends)
            for (const char* const scene : rendered) images += render_all(scene, backend);
        last = Holdings::now();
        if (round == 0) first = last;
        std::cout << images << " images: " << last.kib / 1024 << " MiB, " << last.handles
                  << " files, " << last.threads << " threads" << std::endl;
    }
    EXPECT_LE(last.kib, 1.02 * first.kib);
    EXPECT_EQ(last.handles, first.handles);
    EXPECT_EQ(last.threads, first.threads);
}

}  // namespace
}  // namespace weft::session_soak_slow_test
