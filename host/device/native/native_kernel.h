// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_NATIVE_KERNEL_H
#define WEFT_DEVICE_NATIVE_NATIVE_KERNEL_H

#include <cstdint>

namespace weft {

/// One natively compiled kernel.
struct NativeKernel {
    const char* name;
    /// Runs work-items [begin, end). `arguments` points to `params`, `range`, the NativeScene of a
    /// kernel that traces, and then to each value or first byte of a buffer of the signature.
    void (*run)(const void* const* arguments, std::uint32_t begin, std::uint32_t end);
};

}  // namespace weft

#endif
