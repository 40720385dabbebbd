// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/large_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace weft {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t page = 4096;
constexpr std::size_t huge_page = std::size_t{2} << 20;

std::size_t rounded_up(std::size_t bytes, std::size_t unit) {
    if (bytes > SIZE_MAX - unit) throw std::bad_alloc();
    return (bytes + unit - 1) / unit * unit;
}

bool is_large(std::size_t bytes) noexcept {
    return bytes >= huge_page;
}

// The memory should start at a huge page, so a mapping with room for that is trimmed.
void* map_aligned(std::size_t bytes) {
    const std::size_t room = rounded_up(bytes, page) + huge_page;
    void* const mapped =
        mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    auto* const begin = static_cast<std::byte*>(mapped);
    const auto address = reinterpret_cast<std::uintptr_t>(begin);
    const std::size_t before = (huge_page - address % huge_page) % huge_page;
    const std::size_t after = huge_page - before;
    if (before > 0) munmap(begin, before);
    if (after > 0) munmap(begin + room - after, after);
    madvise(begin + before, room - huge_page, MADV_HUGEPAGE);  // may fail: small pages work, too
    return begin + before;
}

}  // namespace

void* allocate_large(std::size_t bytes) {
    if (is_large(bytes)) return map_aligned(bytes);
    void* const memory =
        std::aligned_alloc(cache_line, rounded_up(std::max<std::size_t>(bytes, 1), cache_line));
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void free_large(void* memory, std::size_t bytes) noexcept {
    if (is_large(bytes))
        munmap(memory, (bytes + page - 1) / page * page);
    else
        std::free(memory);
}

}  // namespace weft
