// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_NATIVE_EXECUTOR_H
#define WEFT_DEVICE_NATIVE_NATIVE_EXECUTOR_H

#include <memory>
#include <vector>

#include "device/executor.h"

namespace weft {

/// The traversal that natively compiled kernels use.
enum class NativeTraversal : std::uint8_t { embree, own_bvh };

/// The host as a device. `threads` is 0 for all cores; `lanes` is the width of packets, as
/// choose_variant takes it.
[[nodiscard]] std::unique_ptr<Executor> make_native_executor(
    NativeTraversal traversal, int threads, std::uint32_t lanes = lanes_from_environment());

/// Description of the native backend without starting it.
[[nodiscard]] DeviceInfo native_device_info(NativeTraversal traversal,
                                            std::uint32_t lanes = lanes_from_environment());

}  // namespace weft

#endif
