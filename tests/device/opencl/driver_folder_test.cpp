// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/testing/temporary_folder.h"
#if WEFT_HAS_OPENCL
#include "base/boot_id.h"
#include "device/opencl/driver_folder.h"

namespace weft::driver_folder_test {
namespace {

namespace fs = std::filesystem;

/// While one lives, no file of the process can grow, as on a full disk.
class FullDisk {
  public:
    FullDisk() {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit none{0, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &none);
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int) = nullptr;
};

/// Gives the variable that the folder sets its old value back.
class DriverFolder : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const char* const text = std::getenv(variable)) before_ = text;
    }
    void TearDown() override {
        if (before_.empty())
            ::unsetenv(variable);
        else
            ::setenv(variable, before_.c_str(), 1);
    }

    static constexpr const char* variable = "POCL_CACHE_DIR";
    std::string before_;
    TemporaryFolder folder_;
};

TEST_F(DriverFolder, TellsWhenItsDiskIsFull) {
    EXPECT_FALSE(driver_folder_is_full()) << "there is no folder";
    const weft::DriverFolder made(folder_.path() / "cache");
    ASSERT_FALSE(made.path().empty());
    EXPECT_EQ(std::getenv(variable), made.path());
    EXPECT_FALSE(driver_folder_is_full());
    {
        const FullDisk full;
        EXPECT_TRUE(driver_folder_is_full());
    }
    EXPECT_FALSE(driver_folder_is_full());
    EXPECT_EQ(full_driver_folder().find((folder_.path() / "cache").string()), 0U);
}

/// A folder as one of these, which holds a file of that system where it is given.
fs::path made_folder(const fs::path& path, const std::string& system, int days = 0) {
    fs::create_directories(path);
    if (!system.empty()) {
        std::ofstream(path / "in-use") << system;
        fs::last_write_time(path / "in-use",
                            fs::file_time_type::clock::now() - std::chrono::days(days));
    }
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::days(days));
    return path;
}

TEST_F(DriverFolder, OthersGoOnlyWhereNobodyUsesThem) {
    const fs::path cache = folder_.path() / "cache";
    const weft::DriverFolder living(cache);
    const fs::path killed = made_folder(cache / "compiling-aB3dEf", boot_id());
    const fs::path killed_early = made_folder(cache / "compiling-aB3dEg", "", 1);
    const fs::path beginning = made_folder(cache / "compiling-aB3dEh", "");
    const fs::path elsewhere = made_folder(cache / "compiling-aB3dEi", "another-system", 20);
    const fs::path long_ago = made_folder(cache / "compiling-aB3dEj", "another-system", 40);
    // What the user keeps, in names that look alike.
    const fs::path guide = made_folder(cache / "compiling-guide", boot_id(), 40);
    const fs::path notes = made_folder(cache / "compiling-notes1", "", 40);
    std::ofstream(notes / "text") << "mine";
    fs::last_write_time(notes, fs::file_time_type::clock::now() - std::chrono::days(40));
    const weft::DriverFolder next(cache);
    EXPECT_TRUE(fs::exists(living.path()));
    EXPECT_NE(living.path(), next.path());
    EXPECT_FALSE(fs::exists(killed));
    EXPECT_FALSE(fs::exists(killed_early));
    EXPECT_TRUE(fs::exists(beginning));
    EXPECT_TRUE(fs::exists(elsewhere));
    EXPECT_FALSE(fs::exists(long_ago));
    EXPECT_TRUE(fs::exists(guide));
    EXPECT_TRUE(fs::exists(notes / "text"));
}

TEST_F(DriverFolder, IsGoneAfterwards) {
    fs::path path;
    {
        const weft::DriverFolder made(folder_.path() / "cache");
        path = made.path();
        EXPECT_TRUE(fs::is_directory(path));
        EXPECT_TRUE(made.trouble().empty());
    }
    EXPECT_FALSE(fs::exists(path));
    EXPECT_FALSE(driver_folder_is_full());
}

}  // namespace
}  // namespace weft::driver_folder_test
#endif
