// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/require_memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <new>

namespace weft::require_memory_test {
namespace {

TEST(RequireMemory, PassesWhereThereIsMemory) {
    EXPECT_NO_THROW(require_memory(0));
    EXPECT_NO_THROW(require_memory(1));
    EXPECT_NO_THROW(require_memory(arena_memory));
}

TEST(RequireMemory, ThrowsWhereThereIsNone) {
    EXPECT_THROW(require_memory(SIZE_MAX / 2), std::bad_alloc);
    EXPECT_THROW(require_memory(SIZE_MAX), std::bad_alloc);
}

}  // namespace
}  // namespace weft::require_memory_test
