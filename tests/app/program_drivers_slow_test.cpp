// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "base/boot_id.h"
#include "tests/testing/expect_line.h"
#include "tests/testing/program_backends.h"
#include "tests/testing/run_program.h"

// What becomes of a program whose OpenCL drivers are bad: tests/device/opencl/faulty_driver.cpp.
namespace weft::program_drivers_slow_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::expect_line;
using test::ProgramResult;
using test::run_program;
using test::RunningProgram;
using test::shipped_scene;
using test::text_of_file;

constexpr const char* pocl_icd = "/etc/OpenCL/vendors/pocl.icd";

/// How long the program may take beside a bad driver, s.
constexpr double longest = 30.0;

class ProgramDriversSlow : public ::testing::Test {
  protected:
    static void SetUpTestSuite() { shared_cache = std::make_unique<TemporaryFolder>(); }
    static void TearDownTestSuite() { shared_cache.reset(); }
    void SetUp() override {
        forget_trials();
        if (test::program_backends().back() != "opencl" || !fs::exists(pocl_icd))
            GTEST_SKIP() << "there is no PoCL";
    }

    /// Names a driver to the program: a library's path, or its name.
    void add_driver(const std::string& name, const std::string& library) {
        fs::create_directories(vendors());
        std::ofstream(vendors() / name) << library << '\n';
    }
    void add_faulty_driver() { add_driver("faulty.icd", WEFT_FAULTY_DRIVER); }
    void add_pocl() {
        std::string library;
        std::getline(std::ifstream(pocl_icd), library);
        add_driver("pocl.icd", library);
    }

    [[nodiscard]] fs::path vendors() const { return folder_.path() / "vendors"; }
    /// Kernels need to be compiled only once for all tests.
    [[nodiscard]] static fs::path cache() { return shared_cache->path(); }
    /// What is remembered of drivers, a file each.
    [[nodiscard]] static std::vector<fs::path> records() {
        std::vector<fs::path> files;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(cache() / "drivers", none))
            if (entry.path().filename().string().starts_with("trial-"))
                files.push_back(entry.path());
        return files;
    }
    static void forget_trials() {
        std::error_code none;
        fs::remove_all(cache() / "drivers", none);
    }
    [[nodiscard]] std::string image() const { return folder_.path() / "image.exr"; }

    [[nodiscard]] RunningProgram::Settings settings(const std::string& fault) const {
        RunningProgram::Settings settings;
        settings.environment = {{"OCL_ICD_VENDORS", vendors()},
                                {"WEFT_CACHE_DIR", cache()},
                                {"WEFT_FAULT", fault},
                                {"WEFT_DRIVER_SECONDS", "12"},
                                // Two devices, of which the driver can make one a faulty one.
                                {"POCL_DEVICES", "pthread basic"},
                                {"WEFT_FAULTY_DEVICE", "pthread"}};
        return settings;
    }
    /// Renders an image of few kernels; `device` is added where it is given.
    [[nodiscard]] ProgramResult render(const RunningProgram::Settings& settings,
                                       const std::string& device = {}) const {
        std::vector<std::string> arguments{"render",      shipped_scene("cornell-box.gltf"),
                                           "--algorithm", "path",
                                           "--spp",       "1",
                                           "--size",      "16x16",
                                           "--progress",  "none",
                                           "-o",          image()};
        if (!device.empty()) arguments.insert(arguments.end(), {"--device", device});
        return run_program(arguments, settings);
    }

    static inline std::unique_ptr<TemporaryFolder> shared_cache;
    TemporaryFolder folder_;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Fault {
    const char* name;
    const char* said;
};

TEST_F(ProgramDriversSlow, DriversThatCannotBeOpenedAreLeftOut) {
    for (const auto& [fault, said] :
         {Fault{"crash-open", "its driver crashes (Segmentation fault)"},
          {"hang-open", "its driver does not answer within 12 s"},
          {"exit-open", "its driver ends the program (exit code 7)"},
          {"quit-open", "its driver ends the program (exit code 0)"},
          {"long-name", "memory"}}) {
        SCOPED_TRACE(fault);
        fs::remove_all(vendors());
        add_faulty_driver();
        const auto begin = std::chrono::steady_clock::now();
        const ProgramResult alone = render(settings(fault));
        EXPECT_LT(seconds_since(begin), longest);
        EXPECT_EQ(alone.exit_code, 0);
        expect_line(alone.err, {"no OpenCL device was found", "faulty.icd", said,
                                "rendering with --backend embree"});
        const ProgramResult named = render(settings(fault), "0");
        EXPECT_EQ(named.exit_code, 3);
        expect_line(named.err, {"no OpenCL device", "faulty.icd", said, "--backend embree"});
    }
}

TEST_F(ProgramDriversSlow, OtherDriversStillRender) {
    add_faulty_driver();
    add_pocl();
    const ProgramResult rendered = render(settings("crash-open"));
    EXPECT_EQ(rendered.exit_code, 0);
    EXPECT_EQ(rendered.err, "");
    EXPECT_TRUE(fs::exists(image()));
    const ProgramResult listed = run_program({"devices", "--check"}, settings("crash-open"));
    EXPECT_EQ(listed.exit_code, 3);
    EXPECT_NE(listed.out.find("driver " + (vendors() / "faulty.icd").string()), std::string::npos);
    EXPECT_NE(listed.out.find("not usable: its driver crashes"), std::string::npos) << listed.out;
}

TEST_F(ProgramDriversSlow, DevicesThatFailAreNeverChosen) {
    add_faulty_driver();
    for (const auto& [fault, said] :
         {Fault{"crash-build", "its driver crashes (Segmentation fault)"},
          {"hang-build", "its driver does not answer within 12 s"},
          {"crash-launch", "its driver crashes (Segmentation fault)"},
          {"hang-launch", "its driver does not answer within 12 s"},
          {"idle-launch", "rays hit what they should not"},
          {"no-units", "its driver says that it has 0 compute units"},
          {"many-units", "compute units"},
          {"no-memory", "a buffer may have 0 bytes"}}) {
        SCOPED_TRACE(fault);
        forget_trials();
        const auto begin = std::chrono::steady_clock::now();
        const ProgramResult named = render(settings(fault), "pthread");
        EXPECT_LT(seconds_since(begin), longest);
        EXPECT_EQ(named.exit_code, 3);
        expect_line(named.err, {"pthread", "is not usable", said, "--backend embree"});
        // What has hung once is remembered.
        const auto again = std::chrono::steady_clock::now();
        const ProgramResult rendered = render(settings(fault));
        EXPECT_LT(seconds_since(again), longest);
        EXPECT_EQ(rendered.exit_code, 0);
        EXPECT_EQ(rendered.err, "");
    }
}

TEST_F(ProgramDriversSlow, FaultsLaterOnEndInOneLine) {
    add_faulty_driver();
    for (const auto& [fault, said] :
         {Fault{"crash-gbuffer", "its driver crashed (segmentation fault)"},
          {"abort-gbuffer", "its driver crashed (abort)"},
          {"exit-gbuffer", "its driver ended the program, expected"},
          {"throw-gbuffer", "its driver ended the program (an exception that it did not catch)"}}) {
        SCOPED_TRACE(fault);
        RunningProgram::Settings with_fault = settings(fault);
        const ProgramResult result =
            run_program({"render", shipped_scene("cornell-box.gltf"), "--size", "16x16", "--spp",
                         "1", "--device", "pthread", "--progress", "none", "-o", image()},
                        with_fault);
        EXPECT_EQ(result.exit_code, 3);
        expect_line(result.err, {said, "--backend embree"});
        EXPECT_FALSE(fs::exists(image()));
        const ProgramResult again = render(with_fault, "pthread");
        EXPECT_EQ(again.exit_code, 3);
        expect_line(
            again.err,
            {"pthread", "is not usable: its driver has ended the program in an earlier run"});
        EXPECT_EQ(render(with_fault).exit_code, 0);
        // A check that it passes makes it usable again.
        EXPECT_EQ(run_program({"devices", "--check"}, with_fault).exit_code, 0);
        EXPECT_EQ(render(with_fault, "pthread").exit_code, 0);
        fs::remove(image());
    }
}

TEST_F(ProgramDriversSlow, AKernelThatDoesNotBuildIsOneLine) {
    add_pocl();
    const fs::path kernels = folder_.path() / "kernels";
    fs::copy(fs::path(WEFT_SOURCE_DIR) / "kernels", kernels, fs::copy_options::recursive);
    std::ofstream(kernels / "core" / "maths.h", std::ios::app) << "\n#error broken on purpose\n";
    RunningProgram::Settings broken = settings("none");
    broken.environment["WEFT_KERNELS"] = kernels;
    const ProgramResult result = render(broken, "pthread");
    EXPECT_EQ(result.exit_code, 3);
    expect_line(result.err, {"weft: kernel ", "does not build on pthread",
                             "error: ", "broken on purpose (log: "});
    const std::size_t begin = result.err.find("(log: ") + 6;
    const std::string log = result.err.substr(begin, result.err.rfind(')') - begin);
    EXPECT_NE(text_of_file(log).find("broken on purpose"), std::string::npos) << log;
    EXPECT_FALSE(fs::exists(image()));
}

TEST_F(ProgramDriversSlow, TrialsAreRepeatedWhereDriversChange) {
    add_faulty_driver();
    const auto failure = [&](const std::string& fault, bool check) {
        std::vector<std::string> arguments{"devices", "--json"};
        if (check) arguments.emplace_back("--check");
        const ProgramResult result = run_program(arguments, settings(fault));
        EXPECT_EQ(result.exit_code, check && fault != "none" ? 3 : 0) << result.err;
        for (const json& device : json::parse(result.out))
            if (device.at("name").get<std::string>().starts_with("pthread"))
                return device.at("failure").get<std::string>();
        return std::string("not listed");
    };
    EXPECT_NE(failure("no-units", false).find("0 compute units"), std::string::npos);
    // What is wrong is in no file, so nothing has changed that could be seen.
    EXPECT_NE(failure("none", false).find("0 compute units"), std::string::npos);
    EXPECT_EQ(failure("none", true), "");
    EXPECT_EQ(failure("no-units", false), "");
    std::ofstream(vendors() / "faulty.icd") << WEFT_FAULTY_DRIVER << "\n\n";
    EXPECT_NE(failure("no-units", false).find("0 compute units"), std::string::npos);
    // A damaged record counts as none.
    for (const std::string text : {"", "[", "{}", "[1]", "{\"failure\": 3}"}) {
        for (const fs::path& file : records()) std::ofstream(file) << text;
        EXPECT_EQ(failure("none", false), "") << text;
    }
}

TEST_F(ProgramDriversSlow, DamagedFilesOfDriversHarmNothing) {
    add_pocl();
    RunningProgram::Settings given = settings("none");
    given.environment["POCL_CACHE_DIR"] = folder_.path() / "pocl";
    ASSERT_EQ(render(given).exit_code, 0);
    const std::string before = text_of_file(image());
    // Whatever lies where drivers keep files is not what later runs load.
    for (const fs::path& kept : {cache(), folder_.path() / "pocl"}) {
        if (!fs::exists(kept)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(kept))
            if (entry.is_regular_file()) fs::resize_file(entry.path(), entry.file_size() / 2);
    }
    const ProgramResult again = render(given);
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(again.err, "");
    EXPECT_EQ(text_of_file(image()), before);
    // A trial that finds no device is none, as with a damaged list of drivers.
    ASSERT_FALSE(records().empty());
    for (const fs::path& file : records())
        EXPECT_FALSE(json::parse(text_of_file(file)).at("devices").empty()) << file;
    for (const auto& entry : fs::directory_iterator(cache()))
        EXPECT_FALSE(entry.path().filename().string().starts_with("compiling-")) << entry.path();
}

TEST_F(ProgramDriversSlow, ACacheThatIsAFileIsReported) {
    add_pocl();
    const std::string file = folder_.write("cache", "no folder");
    RunningProgram::Settings given = settings("none");
    given.environment["WEFT_CACHE_DIR"] = file;
    const fs::path temporary = folder_.path() / "temporary";
    fs::create_directory(temporary);
    given.environment["TMPDIR"] = temporary;
    const ProgramResult result = render(given);
    EXPECT_EQ(result.exit_code, 0);
    expect_line(result.err, {file, "cannot be used", "Not a directory"});
    EXPECT_TRUE(fs::is_empty(temporary)) << fs::directory_iterator(temporary)->path();
}

TEST_F(ProgramDriversSlow, FoldersOfKilledProgramsAreRemoved) {
    add_pocl();
    const fs::path left = cache() / "compiling-abc123";
    fs::create_directories(left);
    std::ofstream(left / "in-use") << boot_id();
    ASSERT_EQ(run_program({"devices"}, settings("none")).exit_code, 0);
    EXPECT_FALSE(fs::exists(left));
}

TEST_F(ProgramDriversSlow, AnotherTimeADriverMayPass) {
    add_pocl();
    // Where memory is limited, what a driver does may be for want of it, and is not remembered.
    RunningProgram::Settings limited = settings("none");
    limited.address_bytes = std::size_t{1} << 40;
    const ProgramResult tried = run_program({"devices"}, limited);
    EXPECT_EQ(tried.exit_code, 0) << tried.err;
    EXPECT_NE(tried.out.find("pthread"), std::string::npos) << tried.out;
    EXPECT_TRUE(records().empty());
    EXPECT_EQ(render(settings("none"), "pthread").exit_code, 0);
    EXPECT_EQ(records().size(), 1U);
}

TEST_F(ProgramDriversSlow, WhoeverStartsItMayIgnoreItsChildren) {
    add_pocl();
    RunningProgram::Settings given = settings("none");
    given.ignores_children = true;
    const ProgramResult result = render(given, "pthread");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
}

TEST_F(ProgramDriversSlow, AFaultWhileOpeningAfterTheTrialIsOneLine) {
    add_faulty_driver();
    ASSERT_EQ(render(settings("none"), "pthread").exit_code, 0);
    for (const auto& [fault, said] :
         {Fault{"crash-open", "an OpenCL driver crashed (segmentation fault)"},
          {"exit-open", "an OpenCL driver ended the program"}}) {
        // Nothing that can be seen has changed, so that it is not tried again.
        const ProgramResult result = render(settings(fault), "pthread");
        EXPECT_EQ(result.exit_code, 3);
        expect_line(result.err, {said, "--backend embree"});
        // From then on the driver is known for what it is.
        const ProgramResult again = render(settings(fault));
        EXPECT_EQ(again.exit_code, 0);
        expect_line(again.err, {"faulty.icd", "its driver ", "rendering with --backend embree"});
        EXPECT_EQ(run_program({"devices", "--check"}, settings("none")).exit_code, 0);
        const ProgramResult list = run_program({"devices"}, settings(fault));
        EXPECT_EQ(list.exit_code, 3);
        expect_line(list.err, {said});
        EXPECT_EQ(run_program({"devices", "--check"}, settings("none")).exit_code, 0);
    }
}

TEST_F(ProgramDriversSlow, ACrashAtTheVeryEndIsNone) {
    add_faulty_driver();
    for (const char* const fault : {"crash-unload", "terminate-unload"}) {
        SCOPED_TRACE(fault);
        fs::remove(image());
        const ProgramResult result = render(settings(fault), "pthread");
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_EQ(result.err, "");
        EXPECT_TRUE(fs::exists(image()));
        EXPECT_EQ(render(settings(fault), "pthread").exit_code, 0);
    }
}

TEST_F(ProgramDriversSlow, DevicesAfterOneThatHangsAreTried) {
    add_faulty_driver();
    RunningProgram::Settings given = settings("hang-build");
    given.environment["WEFT_FAULTY_DEVICE"] = "basic";  // PoCL lists it first
    EXPECT_EQ(render(given, "pthread").exit_code, 0);
    const ProgramResult hung = render(given, "basic");
    EXPECT_EQ(hung.exit_code, 3);
    expect_line(hung.err, {"basic", "is not usable", "does not answer within 12 s"});
}

TEST_F(ProgramDriversSlow, EqualDevicesAreToldApart) {
    add_faulty_driver();
    const auto given = [&](const std::string& fault) {
        RunningProgram::Settings two = settings(fault);
        two.environment["POCL_DEVICES"] = "pthread pthread";
        return two;
    };
    const ProgramResult crashed =
        run_program({"render", shipped_scene("cornell-box.gltf"), "--size", "16x16", "--spp", "1",
                     "--device", "0", "--progress", "none", "-o", image()},
                    given("crash-gbuffer"));
    ASSERT_EQ(crashed.exit_code, 3) << crashed.err;
    EXPECT_EQ(render(given("none"), "0").exit_code, 3);
    EXPECT_EQ(render(given("none"), "1").exit_code, 0);
    // The name is that of both, and one can be used.
    EXPECT_EQ(render(given("none"), "pthread").exit_code, 0);
    EXPECT_EQ(run_program({"devices", "--check"}, given("none")).exit_code, 0);
    EXPECT_EQ(render(given("none"), "0").exit_code, 0);
}

}  // namespace
}  // namespace weft::program_drivers_slow_test
