// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/testing/run_program.h"

namespace weft::program_memory_test {
namespace {

using test::ProgramResult;
using test::run_program;

/// A hilly mesh of 2 * side^2 triangles.
std::string hills(int side) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex " + std::to_string((side + 1) * (side + 1)) +
        "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
        std::to_string(side * side) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x)
            text += std::to_string(x) + " " + std::to_string(y) + " " +
                    std::to_string(2.0 * std::sin(x * 0.3) * std::cos(y * 0.2)) + "\n";
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int corner = y * (side + 1) + x;
            text += "4 " + std::to_string(corner) + " " + std::to_string(corner + 1) + " " +
                    std::to_string(corner + side + 2) + " " + std::to_string(corner + side + 1) +
                    "\n";
        }
    return text;
}

/// The lines that are no warnings.
std::vector<std::string> errors_in(const std::string& text) {
    std::vector<std::string> errors;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("weft: warning: ")) errors.push_back(line);
    return errors;
}

// However far the program gets before memory runs out, it says so and ends: libraries that it uses
// must neither crash nor hang.
TEST(ProgramMemory, EndsWhereMemoryRunsOut) {
    if (std::getenv("WEFT_SANITIZED") != nullptr)
        GTEST_SKIP() << "sanitizers need terabytes of addresses";
    const TemporaryFolder folder;
    const std::string mesh = folder.write("hills.ply", hills(200)).string();
    const std::string image = (folder.path() / "x.png").string();
    const auto render = [&](const std::string& backend, std::size_t mebibytes) {
        return run_program({"render", mesh, "-o", image, "--size", "16x16", "--backend", backend,
                            "--progress", "none"},
                           {.address_bytes = mebibytes << 20, .seconds = 60});
    };
    const auto is_loaded = [&](std::size_t mebibytes) {
        return run_program({"--help"}, {.address_bytes = mebibytes << 20, .seconds = 60})
                   .exit_code == 0;
    };
    constexpr std::size_t plenty = 4096;
    for (const std::string backend : {"embree", "native"}) {
        SCOPED_TRACE(backend);
        ASSERT_EQ(render(backend, plenty).exit_code, 0);
        std::filesystem::remove(image);
        bool enough = false;
        int failures = 0;
        for (std::size_t mebibytes = 64; !enough; mebibytes += 6) {
            SCOPED_TRACE(std::to_string(mebibytes) + " MiB");
            ASSERT_LE(mebibytes, plenty);
            // Libraries that get too little while they are loaded end the program as they please.
            if (!is_loaded(mebibytes)) continue;
            const ProgramResult result = render(backend, mebibytes);
            enough = result.exit_code == 0;
            if (enough) continue;
            EXPECT_EQ(result.exit_code, 4) << result.err;
            const std::vector<std::string> lines = errors_in(result.err);
            EXPECT_EQ(lines.size(), 1u) << result.err;
            if (!lines.empty()) {
                EXPECT_TRUE(lines[0].starts_with("weft: ")) << result.err;
            }
            EXPECT_FALSE(std::filesystem::exists(image));
            ++failures;
        }
        EXPECT_GT(failures, 0);
    }
}

}  // namespace
}  // namespace weft::program_memory_test
