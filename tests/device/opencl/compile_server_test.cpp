// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include "device/opencl/compile_server.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "device/opencl/opencl_executor.h"
#include "device/opencl/program_cache.h"
#include "tests/testing/child_processes.h"
#include "tests/testing/temporary_folder.h"

namespace weft::compile_server_test {
namespace {

namespace fs = std::filesystem;
using test::children_of;
using test::comes_true;
using test::has_ended;

/// Exit code of a check that this machine does not allow.
constexpr int not_here = 77;

void require(bool condition, const std::string& what) {
    if (!condition) throw std::runtime_error(what);
}

/// A server with caches of its own, its own and the driver's, in a process without threads.
class ServerCheck {
  public:
    ServerCheck() : pocl_(made(folder_.path() / "pocl")) {
        const std::vector<OpenClDevice> devices = opencl_devices();
        if (!devices.empty()) device_ = choose_opencl_device("");
    }

    /// Whether there is a device that the server is for, and more than one processor.
    [[nodiscard]] bool possible() const {
        return device_.info.index >= 0 && device_.info.is_cpu && !is_simulator(device_.info) &&
               std::thread::hardware_concurrency() > 1 && !children_of(::getpid()).empty();
    }
    [[nodiscard]] CompileServer& server() { return server_; }
    [[nodiscard]] const OpenClDevice& device() const { return device_; }
    [[nodiscard]] fs::path cache() const { return folder_.path() / "weft"; }
    [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

    [[nodiscard]] ProgramRecipe recipe(const std::string& name, const std::string& source) const {
        const std::string options = "-cl-std=CL1.2";
        return {name, source, options, program_key(device_.device, source, options), 8, 8};
    }
    /// A kernel that adds a number. It has the name and the arguments of a kernel of Weft's, which
    /// are what the server binds, and minds the count of its range.
    [[nodiscard]] ProgramRecipe adding(int number) const {
        return recipe(
            "shadow_edges",
            fmt::format("typedef struct {{ uint words[{}]; }} RenderParams;\n"
                        "typedef struct {{ uint words[{}]; }} LaunchRange;\n"
                        "__kernel __attribute__((reqd_work_group_size(8, 1, 1)))\n"
                        "void shadow_edges(const RenderParams params, const LaunchRange range,\n"
                        "                  __global const uint* from, __global uint* to) {{\n"
                        "    if (get_global_id(0) < range.words[{}]) to[get_global_id(0)] += {};\n"
                        "}}\n",
                        sizeof(shared::RenderParams) / 4, sizeof(shared::LaunchRange) / 4,
                        offsetof(shared::LaunchRange, count) / 4, number));
    }
    [[nodiscard]] CompileRequest request(const std::vector<ProgramRecipe>& programs) const {
        return {static_cast<std::uint32_t>(device_.info.index), 2, cache().string(), programs};
    }
    /// Programs that take seconds to compile.
    [[nodiscard]] CompileRequest long_request() const {
        const ProgramSettings settings{16, 8};
        return request({program_recipe(device_.device, KernelId::vpl_gather, settings, 0),
                        program_recipe(device_.device, KernelId::edge_samples, settings, 0)});
    }

  private:
    static fs::path made(const fs::path& pocl) {
        fs::create_directory(pocl);
        ::setenv("POCL_CACHE_DIR", pocl.c_str(), 1);
        return pocl;
    }
    TemporaryFolder folder_;
    fs::path pocl_;
    CompileServer server_;
    OpenClDevice device_;
};

/// What the program in the cache adds to 10.
int added(const ServerCheck& check, const ProgramRecipe& recipe) {
    const auto binary = ProgramCache(check.cache()).load(recipe.key);
    require(binary.has_value(), "the program is not in the cache");
    const cl::Device& device = check.device().device;
    const cl::Context context(device);
    const cl::CommandQueue queue(context, device);
    const cl::Program program(context, {device}, {*binary});
    program.build({device}, recipe.options.c_str());
    cl::Kernel kernel(program, recipe.name.c_str());
    std::array<cl_int, 8> values{};
    values.fill(10);
    const cl::Buffer buffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, sizeof(values),
                            values.data());
    const shared::RenderParams params{};
    const shared::LaunchRange range{0, 8, 0, 1};
    kernel.setArg(0, sizeof(params), &params);
    kernel.setArg(1, sizeof(range), &range);
    kernel.setArg(2, buffer);
    kernel.setArg(3, buffer);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(8), cl::NDRange(8));
    queue.enqueueReadBuffer(buffer, CL_TRUE, 0, sizeof(values), values.data());
    return values.back() - 10;
}

int check_compiles() {
    ServerCheck check;
    if (!check.possible()) return not_here;
    require(CompileServer::current() == &check.server(), "the server is not the current one");
    const std::vector<ProgramRecipe> programs{check.adding(1), check.adding(2), check.adding(3)};
    for (const std::optional<double> time : check.server().compile(check.request(programs)))
        require(time && *time > 0.0, "a program was not compiled");
    for (int i = 0; i < 3; ++i)
        require(added(check, programs[static_cast<std::size_t>(i)]) == i + 1, "a wrong program");
    // As by Ctrl-C, which goes to all processes of a terminal.
    ::kill(check.server().process(), SIGINT);
    const CompileTimes times = check.server().compile(check.request({check.adding(4)}));
    require(times.size() == 1 && times[0], "nothing was compiled after SIGINT");
    return 0;
}

int check_failures() {
    ServerCheck check;
    if (!check.possible()) return not_here;
    ProgramRecipe other_device = check.adding(2);
    other_device.key = std::string(32, '0');
    ProgramRecipe other_name = check.adding(3);
    other_name.name = "subtract";
    const CompileTimes times = check.server().compile(
        check.request({check.adding(1), check.recipe("broken", "__kernel void broken("),
                       other_device, other_name, check.adding(5)}));
    require(times.size() == 5, "a wrong number of times");
    require(times[0] && times[4], "good programs were not compiled");
    require(!times[1] && !times[2] && !times[3], "a broken program was compiled");
    require(added(check, check.adding(5)) == 5, "a wrong program");
    CompileRequest nowhere = check.request({check.adding(6)});
    nowhere.device = 1000;
    require(!check.server().compile(nowhere)[0], "a device was made up");
    require(check.server().compile(check.request({check.adding(7)}))[0].has_value(),
            "nothing is compiled after failures");
    return 0;
}

int check_unwritable() {
    ServerCheck check;
    if (!check.possible()) return not_here;
    const fs::path below_a_file = check.folder().write("file", "") / "below";
    for (const std::string& folder : {below_a_file.string(), std::string()}) {
        CompileRequest request = check.request({check.adding(1), check.adding(2)});
        request.cache_folder = folder;
        require(check.server().compile(request) == CompileTimes(2), "was stored nowhere");
    }
    require(check.server().compile(check.request({check.adding(1)}))[0].has_value(),
            "nothing is compiled after a folder that cannot be written");
    return 0;
}

int check_killed_workers() {
    ServerCheck check;
    if (!check.possible()) return not_here;
    std::atomic<bool> over{false};
    std::thread killer([&] {
        while (!over) {
            for (const pid_t worker : children_of(check.server().process()))
                ::kill(worker, SIGKILL);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    });
    const CompileTimes times = check.server().compile(check.long_request());
    over = true;
    killer.join();
    require(times == CompileTimes(2), "a killed process has compiled a program");
    require(check.server().compile(check.request({check.adding(1)}))[0].has_value(),
            "nothing is compiled after processes were killed");
    return 0;
}

int check_killed_server() {
    ServerCheck check;
    if (!check.possible()) return not_here;
    std::vector<pid_t> workers;
    std::thread killer([&] {
        const pid_t server = check.server().process();
        (void)comes_true([&] { return (workers = children_of(server)).size() == 2; });
        ::kill(server, SIGKILL);
    });
    const CompileTimes times = check.server().compile(check.long_request());
    killer.join();
    require(workers.size() == 2, "there were not two processes");
    require(times == CompileTimes(2), "a killed server has answered");
    for (const pid_t worker : workers)
        require(comes_true([&] { return has_ended(worker); }), "a process works for nobody");
    require(check.server().compile(check.request({check.adding(1)})) == CompileTimes(1),
            "a server that is gone has answered");
    return 0;
}

int check_end() {
    pid_t process = -1;
    {
        const CompileServer server;
        process = server.process();
        require(process > 0 && !has_ended(process), "there is no server");
        ::kill(process, SIGSTOP);  // even then
    }
    require(CompileServer::current() == nullptr, "an ended server is the current one");
    require(::kill(process, 0) != 0, "the server is still there");
    return 0;
}

/// Programs of an executor that has built two kernels and launched none.
std::vector<KernelBuild> built(const ServerCheck& check, const fs::path& cache, int threads) {
    ::setenv("WEFT_CACHE_DIR", cache.c_str(), 1);
    const auto executor = make_opencl_executor(check.device(), threads);
    executor->build(std::array{KernelId::compose, KernelId::receivers}, 0);
    return executor->builds();
}

/// Programs in the folder, in which there may also be the times of their compilation.
std::ptrdiff_t entries(const fs::path& folder) {
    std::error_code error;
    return std::count_if(fs::directory_iterator(folder, error), {},
                         [](const auto& entry) { return entry.path().extension() == ".program"; });
}

int check_executor() {
    ServerCheck check;
    if (!check.possible()) return not_here;
    // An executor by itself stores a program after its first launch, and there is none here.
    const fs::path cache = check.cache();
    for (const KernelBuild& build : built(check, cache, 0))
        require(!build.from_cache && build.build_ms > 0.0, build.name + " was there before");
    require(entries(cache) == 2, "the server compiled nothing");
    for (const KernelBuild& build : built(check, cache, 0))
        require(build.from_cache, build.name + " was compiled twice");
    const fs::path other = check.folder().path() / "other";
    for (const KernelBuild& build : built(check, other, 1))
        require(!build.from_cache, build.name + " was there before");
    require(entries(other) == 0, "more than one thread was used");
    return 0;
}

[[noreturn]] void end_with(int (*check)()) {
    int code = 1;
    try {
        code = check();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
    std::_Exit(code);
}

bool passed(int status) {
    return WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == not_here);
}

/// A server must be started in a process without threads: each check is one of its own, which
/// begins anew.
class CompileServerDeathTest : public testing::Test {
  protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(CompileServerDeathTest, CompilesIntoTheCache) {
    EXPECT_EXIT(end_with(check_compiles), passed, "");
}

TEST_F(CompileServerDeathTest, ABrokenProgramFailsAlone) {
    EXPECT_EXIT(end_with(check_failures), passed, "");
}

TEST_F(CompileServerDeathTest, WhatCannotBeStoredIsNotDone) {
    EXPECT_EXIT(end_with(check_unwritable), passed, "");
}

TEST_F(CompileServerDeathTest, KilledWorkersLeaveTheRest) {
    EXPECT_EXIT(end_with(check_killed_workers), passed, "");
}

TEST_F(CompileServerDeathTest, AKilledServerCompilesNothing) {
    EXPECT_EXIT(end_with(check_killed_server), passed, "");
}

TEST_F(CompileServerDeathTest, EndsWithItsObject) {
    EXPECT_EXIT(end_with(check_end), passed, "");
}

TEST_F(CompileServerDeathTest, ServesExecutorsWithMoreThanOneThread) {
    EXPECT_EXIT(end_with(check_executor), passed, "");
}

}  // namespace
}  // namespace weft::compile_server_test

#endif
