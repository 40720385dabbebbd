// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_token.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace weft::view_token_test {
namespace {

TEST(ViewToken, TokensAre32DigitsAndDiffer) {
    std::set<std::string> tokens;
    for (int i = 0; i < 100; ++i) {
        const std::string token = make_view_token();
        EXPECT_EQ(token.size(), 32U);
        EXPECT_TRUE(std::ranges::all_of(
            token, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }));
        tokens.insert(token);
    }
    // Two of 128 random bits are equal with a probability of 10^-35.
    EXPECT_EQ(tokens.size(), 100U);
}

TEST(ViewToken, OnlyTheSameTokenIsTheSame) {
    EXPECT_TRUE(is_same_token("0123abcd", "0123abcd"));
    for (const char* given : {"", "0123abc", "0123abcd0", "1123abcd", "0123abce", "0123ABCD"})
        EXPECT_FALSE(is_same_token("0123abcd", given)) << given;
}

}  // namespace
}  // namespace weft::view_token_test
