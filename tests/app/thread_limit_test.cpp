// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/thread_limit.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <fstream>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/limits.h"
#include "tests/testing/run_program.h"

namespace weft::thread_limit_test {
namespace {

using test::RunningProgram;
using test::shipped_scene;

std::size_t allowed() {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

TEST(ThreadLimit, HoldsAsLongAsItLives) {
    const std::size_t before = allowed();
    {
        const ThreadLimit limit(1);
        EXPECT_EQ(allowed(), 1u);
        std::mutex mutex;
        std::set<std::thread::id> threads;
        tbb::parallel_for(0, 1000, [&](int) {
            const std::lock_guard lock(mutex);
            threads.insert(std::this_thread::get_id());
        });
        EXPECT_EQ(threads, std::set<std::thread::id>{std::this_thread::get_id()});
    }
    EXPECT_EQ(allowed(), before);
}

TEST(ThreadLimit, NeverAllowsMore) {
    const std::size_t before = allowed();
    const ThreadLimit none(std::nullopt);
    EXPECT_EQ(allowed(), before);
    const ThreadLimit many(limits::max_threads);
    EXPECT_EQ(allowed(), before);
}

/// Threads that a running process has.
int thread_count(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("Threads:")) return std::stoi(line.substr(8));
    return 0;
}

/// Threads of a rendering that is under way: of its frames, and of scheduling between them.
int threads_of_rendering(const std::string& backend, const std::string& threads) {
    const TemporaryFolder folder;
    RunningProgram program({"render", shipped_scene("cornell-box.gltf"), "--size", "96x96",
                            "--algorithm", "ais", "--backend", backend, "--threads", threads,
                            "--spp", "100000", "--progress", "plain", "-o",
                            folder.path() / "x.exr"});
    // The first line comes at the start, the second a second later.
    EXPECT_TRUE(program.wait_for_lines(2)) << program.err();
    return thread_count(program.process());
}

TEST(ThreadLimit, IsInForceInRenderings) {
    if (thread_count(::getpid()) == 0) GTEST_SKIP() << "the system does not tell";
    EXPECT_EQ(threads_of_rendering("native", "1"), 1);
    EXPECT_EQ(threads_of_rendering("embree", "1"), 1);
    if (allowed() > 1) {
        EXPECT_GT(threads_of_rendering("native", "2"), 1);
    }
}

}  // namespace
}  // namespace weft::thread_limit_test
