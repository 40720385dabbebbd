// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include "device/opencl/compile_request.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

namespace weft::compile_request_test {
namespace {

CompileRequest some_request() {
    return {
        3, 2, "/a folder", {{"name", "source", "-options", "key", 4096, 8}, {"", "", "", "other"}}};
}

TEST(CompileRequestBytes, RequestsComeBack) {
    const auto found = decode_request(encode(some_request()));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->device, 3u);
    EXPECT_EQ(found->workers, 2u);
    EXPECT_EQ(found->cache_folder, "/a folder");
    ASSERT_EQ(found->programs.size(), 2u);
    EXPECT_EQ(found->programs[0].name, "name");
    EXPECT_EQ(found->programs[0].source, "source");
    EXPECT_EQ(found->programs[0].options, "-options");
    EXPECT_EQ(found->programs[0].key, "key");
    EXPECT_EQ(found->programs[0].global_size, 4096u);
    EXPECT_EQ(found->programs[0].local_size, 8u);
    EXPECT_EQ(found->programs[1].key, "other");
}

TEST(CompileRequestBytes, WhatIsNoRequestIsRefused) {
    std::vector<std::byte> bytes = encode(some_request());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decode_request(std::span(bytes).first(size))) << size << " bytes";
    // Every number that is too large, lengths among them, which would be allocated.
    const std::uint64_t large = std::numeric_limits<std::uint64_t>::max() / 2;
    for (const std::size_t at :
         {std::size_t{0}, std::size_t{8}, std::size_t{16}, std::size_t{33}}) {
        std::vector<std::byte> changed = bytes;
        std::memcpy(changed.data() + at, &large, sizeof(large));
        EXPECT_FALSE(decode_request(changed)) << "byte " << at;
    }
    bytes.push_back(std::byte{0});
    EXPECT_FALSE(decode_request(bytes));
}

TEST(CompileRequestBytes, TimesComeBack) {
    const CompileTimes times{1.5, std::nullopt, 0.0};
    EXPECT_EQ(decode_times(encode(times), 3), times);
    EXPECT_FALSE(decode_times(encode(times), 2));
    EXPECT_FALSE(decode_times(encode(times), 4));
    const CompileTimes odd{std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN(), -3.0};
    EXPECT_EQ(decode_times(encode(odd), 3), CompileTimes(3));
}

}  // namespace
}  // namespace weft::compile_request_test

#endif
