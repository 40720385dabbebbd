// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/testing/temporary_folder.h"
#if WEFT_HAS_OPENCL
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
