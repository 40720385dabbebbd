// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/cache_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <system_error>

#include "tests/testing/temporary_folder.h"

namespace weft::cache_folder_test {
namespace {

namespace fs = std::filesystem;

// Drivers execute what lies there, so that nobody else may put anything in.
TEST(CacheFolder, WhatIsMadeIsForTheUserAlone) {
    const TemporaryFolder folder;
    const fs::path made = folder.path() / "cache" / "weft" / "programs";
    make_cache_folder(made);
    for (fs::path at = made; at != folder.path(); at = at.parent_path())
        EXPECT_EQ(fs::status(at).permissions(), fs::perms::owner_all) << at;
    fs::permissions(made, fs::perms::group_read, fs::perm_options::add);
    const fs::perms chosen = fs::status(made).permissions();
    make_cache_folder(made);
    EXPECT_EQ(fs::status(made).permissions(), chosen) << "a folder of the user's was changed";
}

TEST(CacheFolder, AFileInTheWayIsNamedAsThat) {
    const TemporaryFolder folder;
    const fs::path file = folder.write("cache", "text");
    for (const fs::path& wanted : {file, file / "programs"}) {
        try {
            make_cache_folder(wanted);
            FAIL() << wanted << " was made";
        } catch (const fs::filesystem_error& error) {
            EXPECT_EQ(error.code(), std::errc::not_a_directory) << error.what();
        }
    }
}

}  // namespace
}  // namespace weft::cache_folder_test
