// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_FREE_MEMORY_H
#define WEFT_BASE_FREE_MEMORY_H

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace weft {

/// Gives memory that the program has freed back to the system, where the allocator can do so. For
/// the end of large, rare pieces of work in threads of their own, whose arenas would keep it.
inline void return_free_memory() noexcept {
#ifdef __GLIBC__
    (void)malloc_trim(0);
#endif
}

/// Makes large blocks pages of their own, which go back to the system as soon as they are freed.
/// By itself the allocator of glibc learns from each large block that is freed to keep the next.
/// For programs that run for hours and change what they hold: an allocation costs a few pages more.
inline void map_large_blocks() noexcept {
#ifdef __GLIBC__
    constexpr int large = 1 << 18;
    (void)mallopt(M_MMAP_THRESHOLD, large);
#endif
}

}  // namespace weft

#endif
