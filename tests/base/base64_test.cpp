// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/base64.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace weft::base64_test {
namespace {

std::string encoded(const std::string& text) {
    return encode_base64(std::as_bytes(std::span(text)));
}

// RFC 4648, section 10.
TEST(Base64, KnowsTheVectorsOfTheStandard) {
    const std::vector<std::pair<std::string, std::string>> vectors = {{"", ""},
                                                                      {"f", "Zg=="},
                                                                      {"fo", "Zm8="},
                                                                      {"foo", "Zm9v"},
                                                                      {"foob", "Zm9vYg=="},
                                                                      {"fooba", "Zm9vYmE="},
                                                                      {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, text] : vectors) {
        EXPECT_EQ(encoded(plain), text);
        const std::vector<std::byte> back = decode_base64(text, "here");
        EXPECT_EQ(std::string(reinterpret_cast<const char*>(back.data()), back.size()), plain);
    }
}

TEST(Base64, GivesEveryByteBack) {
    std::vector<std::byte> bytes;
    for (int i = 0; i < 256; ++i) bytes.push_back(static_cast<std::byte>(i));
    const std::string text = encode_base64(bytes);
    EXPECT_EQ(text.size(), 344U);
    EXPECT_NE(text.find('+'), std::string::npos);
    EXPECT_NE(text.find('/'), std::string::npos);
    EXPECT_EQ(decode_base64(text, "here"), bytes);
}

}  // namespace
}  // namespace weft::base64_test
