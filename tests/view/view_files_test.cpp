// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_files.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

namespace weft::view_files_test {
namespace {

TEST(ViewFiles, NeverNamesAFileThatIsThere) {
    const TemporaryFolder folder;
    const ViewFiles files(folder.path());
    EXPECT_EQ(files.next(".png"), folder.path() / "view-001.png");
    EXPECT_EQ(files.write({{"a", 1}}, ".edits.json"), folder.path() / "view-001.edits.json");
    EXPECT_EQ(files.write({{"a", 2}}, ".edits.json"), folder.path() / "view-002.edits.json");
    EXPECT_EQ(test::text_of_file(folder.path() / "view-002.edits.json"), "{\n  \"a\": 2\n}\n");
    EXPECT_EQ(files.next(".png"), folder.path() / "view-001.png");
}

TEST(ViewFiles, SaysWhereNothingCanBeSaved) {
    const ViewFiles files{{}};
    try {
        (void)files.next(".png");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("--output"), std::string::npos);
    }
}

}  // namespace
}  // namespace weft::view_files_test
