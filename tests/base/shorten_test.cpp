// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/shorten.h"

#include <gtest/gtest.h>

#include <string>

namespace weft::shorten_test {
namespace {

TEST(Shorten, CountsCharactersNotBytes) {
    EXPECT_EQ(count_characters(""), 0U);
    EXPECT_EQ(count_characters("abc"), 3U);
    EXPECT_EQ(count_characters("\u00e9\u20ac\U0001F98A"), 3U);
    EXPECT_EQ(first_characters("\u00e9\u20acx", 2), "\u00e9\u20ac");
    EXPECT_EQ(first_characters("ab", 5), "ab");
}

TEST(Shorten, LeavesOutTheMiddle) {
    EXPECT_EQ(without_middle("abcdefgh", 8), "abcdefgh");
    EXPECT_EQ(without_middle("abcdefgh", 7), "ab...gh");
    EXPECT_EQ(without_middle("abcdefgh", 6), "a...gh");
    EXPECT_EQ(without_middle("abcdefgh", 3), "...");
    EXPECT_EQ(without_middle("\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9", 5), "\u00e9...\u00e9");
}

TEST(Shorten, TakesBytesThatAreNoCharacters) {
    const std::string bytes(40, '\x80');
    EXPECT_EQ(without_middle(bytes, 4), bytes) << "it is nothing that could be shortened";
    EXPECT_EQ(count_characters(without_middle("ab\xff\xff\xff\xff\xff\xff", 5)), 5U);
}

}  // namespace
}  // namespace weft::shorten_test
