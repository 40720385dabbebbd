// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_NATIVE_VARIANTS_H
#define WEFT_DEVICE_NATIVE_NATIVE_VARIANTS_H

#include <cstdint>
#include <string_view>
#include <vector>

#include "device/native/native_kernel.h"

namespace weft {

/// All kernels as compiled for one instruction set and number of lanes.
struct NativeVariant {
    std::string_view isa;  ///< the instruction set it needs: "base", "x86_64_v3" or "x86_64_v4"
    std::uint32_t lanes;
    std::vector<NativeKernel> kernels;  ///< in the order of KernelId
};

/// The compiled variants that this processor can run, the most basic instruction set first.
[[nodiscard]] std::vector<NativeVariant> runnable_variants();

/// The variant to use: `lanes` wide where that is not 0, else as wide as the processor's vectors;
/// of several the one for the newest instruction set. Throws Error (exit code 3) if there is none.
[[nodiscard]] NativeVariant choose_variant(std::uint32_t lanes);

}  // namespace weft

#endif
