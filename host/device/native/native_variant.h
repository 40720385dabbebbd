// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_NATIVE_VARIANT_H
#define WEFT_DEVICE_NATIVE_NATIVE_VARIANT_H

#include <cstddef>
#include <cstdint>

namespace weft {

/// One natively compiled kernel.
struct NativeKernel {
    const char* name;
    /// Runs work-items [begin, end). `arguments` points to `params`, `range`, the NativeScene of a
    /// kernel that traces, and then to each value or first byte of a buffer of the signature.
    void (*run)(const void* const* arguments, std::uint32_t begin, std::uint32_t end);
};

/// All kernels compiled for one instruction set and packet width.
struct NativeVariant {
    int lanes;
    const NativeKernel* kernels;
    std::size_t kernel_count;
};

}  // namespace weft

#endif
