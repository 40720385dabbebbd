// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/quote.h"

#include <gtest/gtest.h>

#include <string>

#include "base/diagnostics.h"
#include "base/error.h"

namespace weft::quote_test {
namespace {

TEST(Quote, OneLineHasNoControlCharacters) {
    std::string all;
    for (int code = 0; code < 256; ++code) all += static_cast<char>(code);
    const std::string text = one_line(all);
    ASSERT_EQ(text.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_EQ(text[i], i < 0x20 || i == 0x7F ? '?' : all[i]) << i;
    EXPECT_EQ(one_line(""), "");
}

TEST(Quote, NamesOfFilesLeaveMessagesOnOneLine) {
    EXPECT_STREQ(Error(ExitCode::output, "a\nb.exr", "is full").what(), "a?b.exr: is full");
    Diagnostics diagnostics;
    diagnostics.warn("c\r.obj", "is odd");
    EXPECT_EQ(diagnostics.warnings().at(0), "c?.obj: is odd");
}

TEST(Quote, QuotesAndCuts) {
    EXPECT_EQ(quote("a\nb\x7F"), "'a?b?'");
    EXPECT_EQ(quote(""), "''");
    EXPECT_EQ(quote(std::string(80, 'x')), "'" + std::string(80, 'x') + "'");
    EXPECT_EQ(quote(std::string(81, 'x')), "'" + std::string(80, 'x') + "...'");
}

}  // namespace
}  // namespace weft::quote_test
