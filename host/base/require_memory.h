// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_REQUIRE_MEMORY_H
#define WEFT_BASE_REQUIRE_MEMORY_H

#include <cstddef>

namespace weft {

/// What TBB takes for an arena and its first threads, in bytes, amply. TBB 2021 to 2022 waits for
/// ever where it gets less: its error is thrown while it holds a lock that throwing takes again.
constexpr std::size_t arena_memory = std::size_t{4} << 20;

/// Throws std::bad_alloc unless `bytes` more are to be had at this moment. For use before calls of
/// libraries that do not survive running out of memory.
void require_memory(std::size_t bytes);

}  // namespace weft

#endif
