// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_NATIVE_VARIANTS_H
#define WEFT_DEVICE_NATIVE_NATIVE_VARIANTS_H

#include <cstdint>
#include <string_view>
#include <vector>

#include "device/native/native_variant.h"

namespace weft {

/// A compiled variant and the instruction set it needs: "base", "x86_64_v3" or "x86_64_v4".
struct IsaVariant {
    std::string_view isa;
    const NativeVariant* kernels;
};

/// The compiled variants that this processor can run, the most basic instruction set first.
[[nodiscard]] std::vector<IsaVariant> runnable_variants();

/// The variant to use: `lanes` wide where that is not 0, else as wide as the processor's vectors;
/// of several the one for the newest instruction set. Throws Error (exit code 3) if there is none.
[[nodiscard]] IsaVariant choose_variant(std::uint32_t lanes);

}  // namespace weft

#endif
