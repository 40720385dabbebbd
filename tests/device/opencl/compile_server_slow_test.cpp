// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "device/opencl/opencl_devices.h"
#include "image/exr.h"
#include "tests/testing/child_processes.h"
#include "tests/testing/run_program.h"

namespace weft::compile_server_slow_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::children_of;
using test::comes_true;
using test::RunningProgram;
using test::text_of_file;

/// Images by the program, each compiling every kernel that it needs.
class CompileServerSlow : public testing::Test {
  protected:
    struct Run {
        int exit_code = -1;
        std::string messages;
        json stats;
        Image image;
        bool had_workers = false;
        std::size_t entries = 0;  ///< programs in the cache
    };
    using Interference = std::function<void(pid_t program, pid_t server)>;

    void SetUp() override {
        if (opencl_devices().empty()) GTEST_SKIP() << "there is no OpenCL device";
        const DeviceInfo device = choose_opencl_device("").info;
        if (!device.is_cpu || is_simulator(device) || std::thread::hardware_concurrency() < 2)
            GTEST_SKIP() << "kernels are compiled by one process";
        if (process_state_unknown()) GTEST_SKIP() << "the system does not tell of processes";
    }

    /// With empty caches; `interfere` is called when workers are at it.
    static Run cold_image(const Interference& interfere) {
        const TemporaryFolder folder;
        const auto at = [&](const std::string& name) { return (folder.path() / name).string(); };
        fs::create_directory(at("pocl"));
        RunningProgram::Settings settings;
        settings.environment = {{"WEFT_CACHE_DIR", at("weft")}, {"POCL_CACHE_DIR", at("pocl")}};
        // A trial of the driver is over; what it has compiled is removed again.
        EXPECT_EQ(test::run_program({"devices"}, settings).exit_code, 0);
        for (const auto& entry : fs::directory_iterator(at("weft")))
            if (entry.path().extension() == ".program") fs::remove(entry.path());
        RunningProgram program(
            {"render", test::shipped_scene("cornell-box.gltf"), "-o", at("x.exr"), "--size",
             "48x40", "--stats", at("x.json"), "--backend", "opencl", "--progress", "none",
             "--algorithm", "igi", "--components", "direct"},
            settings);
        Run run;
        // A program that is told to end may have ended before it is asked.
        (void)comes_true([&] {
            for (const pid_t server : children_of(program.process()))
                if (!children_of(server).empty()) {
                    interfere(program.process(), server);
                    run.had_workers = true;
                }
            return run.had_workers || test::has_ended(program.process());
        });
        run.exit_code = program.wait();
        run.messages = program.err();
        run.stats = json::parse(text_of_file(at("x.json")), nullptr, false);
        if (fs::exists(at("x.exr"))) run.image = read_exr(at("x.exr"));
        for (const auto& entry : fs::directory_iterator(at("weft")))
            if (entry.path().extension() == ".program") ++run.entries;
        return run;
    }

    static void expect_compiled(const Run& run) {
        EXPECT_TRUE(run.had_workers);
        ASSERT_TRUE(run.stats.is_object());
        EXPECT_GT(run.entries, 2u);
        EXPECT_EQ(run.stats.at("kernels").size(), run.entries);
        for (const json& kernel : run.stats["kernels"]) {
            EXPECT_EQ(kernel.at("from_cache"), false) << kernel;
            EXPECT_GT(kernel.at("build_ms"), 0.0) << kernel;
        }
    }

  private:
    static bool process_state_unknown() { return test::has_ended(::getpid()); }
};

TEST_F(CompileServerSlow, AKilledServerCostsNoImage) {
    const Run undisturbed = cold_image([](pid_t, pid_t) {});
    EXPECT_EQ(undisturbed.exit_code, 0);
    EXPECT_EQ(undisturbed.messages, "");
    expect_compiled(undisturbed);
    const Run killed = cold_image([](pid_t, pid_t server) { ::kill(server, SIGKILL); });
    EXPECT_EQ(killed.exit_code, 0);
    EXPECT_EQ(killed.messages, "");
    expect_compiled(killed);
    ASSERT_FALSE(undisturbed.image.layers.empty());
    ASSERT_EQ(killed.image.layers.size(), undisturbed.image.layers.size());
    for (std::size_t layer = 0; layer < killed.image.layers.size(); ++layer)
        EXPECT_EQ(killed.image.layers[layer].values, undisturbed.image.layers[layer].values);
}

TEST_F(CompileServerSlow, CtrlCEndsTheProgramAtOnce) {
    // A terminal sends it to the whole group of processes. There is no light yet that an image
    // could show.
    const Run run = cold_image([](pid_t program, pid_t server) {
        for (const pid_t worker : children_of(server)) ::kill(worker, SIGINT);
        ::kill(server, SIGINT);
        ::kill(program, SIGINT);
    });
    EXPECT_TRUE(run.had_workers);
    EXPECT_EQ(run.exit_code, 130);
    EXPECT_NE(run.messages.find("interrupted"), std::string::npos) << run.messages;
    EXPECT_TRUE(run.image.layers.empty());
    EXPECT_TRUE(run.stats.is_discarded()) << "statistics of nothing";
}

}  // namespace
}  // namespace weft::compile_server_slow_test

#endif
