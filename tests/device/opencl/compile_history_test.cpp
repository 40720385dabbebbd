// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include "device/opencl/compile_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/testing/temporary_folder.h"

namespace weft::compile_history_test {
namespace {

namespace fs = std::filesystem;

ProgramRecipe recipe(const std::string& name, std::size_t length) {
    ProgramRecipe made;
    made.name = name;
    made.source = std::string(length, 'x');
    return made;
}

DeviceInfo device(const std::string& name) {
    DeviceInfo info;
    info.name = name;
    return info;
}

TEST(CompileHistory, GivesWhatTheLastRunHasLeft) {
    const TemporaryFolder folder;
    CompileHistory first(folder.path(), device("a"));
    first.add(recipe("path", 10), 1234.5);
    first.add(recipe("compose", 10), 10.0);
    first.store();
    const CompileHistory second(folder.path(), device("a"));
    EXPECT_DOUBLE_EQ(second.expected_ms(recipe("path", 10)), 1234.5);
    EXPECT_DOUBLE_EQ(second.expected_ms(recipe("compose", 10)), 10.0);
    CompileHistory third(folder.path(), device("a"));
    third.add(recipe("path", 10), 800.0);
    third.store();
    EXPECT_DOUBLE_EQ(CompileHistory(folder.path(), device("a")).expected_ms(recipe("path", 10)),
                     800.0);
    EXPECT_EQ(folder.entry_count(), 1U);
    EXPECT_NE(CompileHistory(folder.path(), device("b")).expected_ms(recipe("path", 10)), 800.0)
        << "another device";
}

TEST(CompileHistory, GoesByTheSourceWhereNothingIsKnown) {
    const CompileHistory none(fs::path(), device("a"));
    const double small = none.expected_ms(recipe("x", 80'000));
    const double large = none.expected_ms(recipe("y", 220'000));
    EXPECT_GT(small, 50.0);
    EXPECT_GT(large, 4.0 * small);
    EXPECT_LT(large, 10'000.0);
    EXPECT_GT(none.expected_ms(recipe("z", 0)), 0.0);
}

TEST(CompileHistory, DamagedFilesAreNoError) {
    const TemporaryFolder folder;
    CompileHistory first(folder.path(), device("a"));
    first.add(recipe("path", 10), 77.0);
    first.store();
    const fs::path file = fs::directory_iterator(folder.path())->path();
    for (const char* const text : {"", "\n\n", "path", "path x", "path -5", "path 0", "path nan",
                                   "path inf", "path 1e300", "\xff\xfe 5\n\0", "path 1 2 3 path"}) {
        std::ofstream(file, std::ios::trunc) << text << "\ncompose 5.5\n";
        const CompileHistory read(folder.path(), device("a"));
        EXPECT_DOUBLE_EQ(read.expected_ms(recipe("compose", 10)), 5.5) << text;
        EXPECT_NE(read.expected_ms(recipe("path", 10)), 77.0) << text;
    }
    fs::remove(file);
    fs::create_directory(file);
    CompileHistory blocked(folder.path(), device("a"));
    blocked.add(recipe("path", 10), 5.0);
    blocked.store();
}

TEST(CompileHistory, WhatADriverHadInItsOwnCacheIsNoCompilation) {
    const TemporaryFolder folder;
    CompileHistory history(folder.path(), device("a"));
    const ProgramRecipe large = recipe("path", 200'000);
    const double guess = history.expected_ms(large);
    history.add(large, 0.1 * guess);
    EXPECT_EQ(history.expected_ms(large), guess);
    history.add(large, 3.0 * guess);
    EXPECT_EQ(history.expected_ms(large), 3.0 * guess);
    history.add(large, 0.1 * guess);
    EXPECT_EQ(history.expected_ms(large), 3.0 * guess);
    history.add(large, guess);
    EXPECT_EQ(history.expected_ms(large), guess);
}

TEST(CompileHistory, OnlyTimesAreKept) {
    const TemporaryFolder folder;
    CompileHistory history(folder.path(), device("a"));
    for (const double ms : {0.0, -1.0, std::nan(""), HUGE_VAL}) history.add(recipe("path", 10), ms);
    history.store();
    EXPECT_EQ(folder.entry_count(), 0U);
}

}  // namespace
}  // namespace weft::compile_history_test

#endif
