// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/shell_word.h"

#include <gtest/gtest.h>

namespace weft::shell_word_test {
namespace {

TEST(ShellWord, QuotesWhatAShellWouldTakeApart) {
    EXPECT_EQ(shell_word("scenes/office.gltf"), "scenes/office.gltf");
    EXPECT_EQ(shell_word("two words"), "'two words'");
    EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
    EXPECT_EQ(shell_word("$(reboot);`x`"), "'$(reboot);`x`'");
    EXPECT_EQ(shell_word("-o"), "-o");
    EXPECT_EQ(shell_word(""), "''");
}

TEST(ShellWord, FilesAreNoOptions) {
    EXPECT_EQ(shell_file("-o"), "./-o");
    EXPECT_EQ(shell_file("-o x"), "'./-o x'");
    EXPECT_EQ(shell_file("a-o"), "a-o");
}

}  // namespace
}  // namespace weft::shell_word_test
