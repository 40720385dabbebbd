// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/content_digest.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::content_digest_test {
namespace {

std::string digest_of(const std::vector<std::string_view>& pieces) {
    ContentDigest digest;
    for (const std::string_view piece : pieces) digest.add(piece);
    return digest.text();
}

TEST(ContentDigest, DiffersWithEveryPiece) {
    std::set<std::string> digests;
    const std::vector<std::vector<std::string_view>> different{
        {},         {""},       {"", ""},   {"a"},      {"b"},          {"ab"},
        {"a", "b"}, {"b", "a"}, {"ab", ""}, {"", "ab"}, {"a", "", "b"}, {"a", "b", ""}};
    for (const auto& pieces : different) {
        const std::string digest = digest_of(pieces);
        EXPECT_EQ(digest.size(), 32U);
        EXPECT_EQ(digest.find_first_not_of("0123456789abcdef"), std::string::npos);
        digests.insert(digest);
    }
    EXPECT_EQ(digests.size(), different.size());
    EXPECT_EQ(digest_of({"a", "b"}), digest_of({"a", "b"}));
}

TEST(ContentDigest, BothHalvesDependOnEveryBitOfAnyLength) {
    for (const std::size_t length : {1U, 7U, 8U, 31U, 32U, 33U, 100U}) {
        std::set<std::string> low;
        std::set<std::string> high;
        std::string text(length, 'k');
        for (std::size_t at = 0; at < length; ++at)
            for (int bit = 0; bit < 8; ++bit) {
                text[at] = static_cast<char>(text[at] ^ 1 << bit);
                const std::string digest = digest_of({text});
                low.insert(digest.substr(0, 16));
                high.insert(digest.substr(16));
                text[at] = static_cast<char>(text[at] ^ 1 << bit);
            }
        EXPECT_EQ(low.size(), 8 * length);
        EXPECT_EQ(high.size(), 8 * length);
    }
}

TEST(ContentDigest, ZerosOfOtherLengthDiffer) {
    std::set<std::string> digests;
    for (std::size_t length = 0; length < 100; ++length)
        digests.insert(digest_of({std::string(length, '\0')}));
    EXPECT_EQ(digests.size(), 100U);
}

TEST(ContentDigest, ExchangedWordsDiffer) {
    std::string text;
    for (char c = 'a'; c < 'a' + 8; ++c) text += std::string(8, c);
    std::set<std::string> digests{digest_of({text})};
    for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            std::string other = text;
            for (std::size_t i = 0; i < 8; ++i) std::swap(other[8 * a + i], other[8 * b + i]);
            digests.insert(digest_of({other}));
        }
    EXPECT_EQ(digests.size(), 1U + 28U);
}

}  // namespace
}  // namespace weft::content_digest_test
