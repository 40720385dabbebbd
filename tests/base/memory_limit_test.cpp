// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/memory_limit.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <optional>

namespace weft::memory_limit_test {
namespace {

TEST(MemoryLimit, IsWhatTheSystemWasTold) {
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
    constexpr rlim_t terabyte = rlim_t{1} << 40;
    const rlimit given{terabyte, before.rlim_max};
    if (::setrlimit(RLIMIT_AS, &given) != 0) GTEST_SKIP() << "less is allowed here";
    const std::optional<std::uint64_t> limit = memory_limit();
    ::setrlimit(RLIMIT_AS, &before);
    EXPECT_EQ(limit, terabyte);
    if (before.rlim_cur == RLIM_INFINITY) {
        EXPECT_FALSE(memory_limit().has_value());
    }
}

}  // namespace
}  // namespace weft::memory_limit_test
