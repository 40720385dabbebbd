// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_LARGE_MEMORY_H
#define WEFT_BASE_LARGE_MEMORY_H

#include <cstddef>
#include <limits>
#include <new>
#include <vector>

namespace weft {

/// Allocates memory in whole cache lines, at least 64 bytes; large pieces on huge pages where the
/// system has them, since random access to a BVH of 200 MB spends a tenth of its time on TLB
/// misses. Not initialised. Throws std::bad_alloc.
[[nodiscard]] void* allocate_large(std::size_t bytes);

/// Frees what allocate_large returned.
void free_large(void* memory, std::size_t bytes) noexcept;

/// Owns memory of allocate_large.
class LargeMemory {
  public:
    explicit LargeMemory(std::size_t bytes) : data_(allocate_large(bytes)), bytes_(bytes) {}
    ~LargeMemory() { free_large(data_, bytes_); }
    LargeMemory(const LargeMemory&) = delete;
    LargeMemory& operator=(const LargeMemory&) = delete;

    [[nodiscard]] void* data() const noexcept { return data_; }

  private:
    void* data_;
    std::size_t bytes_;
};

/// Allocator that lets containers use memory of allocate_large.
template <class T>
struct LargeAllocator {
    using value_type = T;

    LargeAllocator() noexcept = default;
    template <class U>
    LargeAllocator(const LargeAllocator<U>&) noexcept {}

    [[nodiscard]] T* allocate(std::size_t count) {
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(T))
            throw std::bad_array_new_length();
        return static_cast<T*>(allocate_large(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t count) noexcept {
        free_large(memory, count * sizeof(T));
    }
    template <class U>
    bool operator==(const LargeAllocator<U>&) const noexcept {
        return true;
    }
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace weft

#endif
