// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_NATIVE_VARIANT_H
#define WEFT_DEVICE_NATIVE_NATIVE_VARIANT_H

#include <cstddef>
#include <cstdint>

namespace weft {

/// How one kernel argument is handed over.
struct KernelArgument {
    bool is_pointer;   ///< a buffer, else a value
    std::size_t size;  ///< bytes of a value; 0 for buffers
};

/// One natively compiled kernel.
struct NativeKernel {
    const char* name;
    const KernelArgument* arguments;
    std::size_t argument_count;
    /// Runs work-items [begin, end). `arguments[i]` is the buffer's first byte or points to the
    /// value.
    void (*run)(void* const* arguments, std::uint32_t begin, std::uint32_t end);
};

/// All kernels compiled for one instruction set and packet width.
struct NativeVariant {
    int lanes;
    const NativeKernel* kernels;
    std::size_t kernel_count;
};

}  // namespace weft

#endif
