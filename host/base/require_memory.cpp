// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/require_memory.h"

#include <sys/mman.h>

#include <new>

namespace weft {

void require_memory(std::size_t bytes) {
    if (bytes == 0) return;
    // Asked of the system and not of the heap: what the heap has free may be in pieces.
    void* const probe =
        mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (probe == MAP_FAILED) throw std::bad_alloc();
    munmap(probe, bytes);
}

}  // namespace weft
