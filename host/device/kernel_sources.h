// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_KERNEL_SOURCES_H
#define WEFT_DEVICE_KERNEL_SOURCES_H

#include <span>
#include <string_view>

namespace weft {

/// One file of kernels/ as it was when the program was built.
struct KernelSource {
    std::string_view name;  ///< path relative to kernels/, as an #include gives it
    std::string_view text;  ///< ASCII; a NUL follows its end
};

/// Every file of kernels/ (headers, kernels and lists), in no promised order. The data lives as
/// long as the program.
[[nodiscard]] std::span<const KernelSource> kernel_sources();

}  // namespace weft

#endif
