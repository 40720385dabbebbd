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

}  // namespace weft

#endif
