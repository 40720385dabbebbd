// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_EXPECT_LINE_H
#define WEFT_TESTS_TESTING_EXPECT_LINE_H

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace weft::test {

/// Expects one whole line, which begins with the program's name and has all of these parts.
inline void expect_line(const std::string& text, const std::vector<std::string>& parts = {}) {
    EXPECT_TRUE(text.starts_with("weft: ")) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    EXPECT_TRUE(text.ends_with('\n')) << text;
    for (const std::string& part : parts)
        EXPECT_NE(text.find(part), std::string::npos) << part << " is missing: " << text;
}

}  // namespace weft::test

#endif
