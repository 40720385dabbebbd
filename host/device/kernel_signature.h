// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_KERNEL_SIGNATURE_H
#define WEFT_DEVICE_KERNEL_SIGNATURE_H

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "device/executor.h"

namespace weft {

/// One argument of a kernel as kernels/core/signatures.h declares it.
struct ArgumentInfo {
    std::string_view name;
    bool is_value;      ///< false: a buffer
    std::size_t bytes;  ///< of a value, or of a pointer to a buffer
};

/// Most bytes of all arguments of a kernel: the least CL_DEVICE_MAX_PARAMETER_SIZE of OpenCL.
inline constexpr std::size_t most_argument_bytes = 1024;

/// The arguments of a kernel after `params`, `range` and the scene.
[[nodiscard]] std::span<const ArgumentInfo> kernel_arguments(KernelId kernel);

/// Whether a kernel traces rays, and so takes a scene.
[[nodiscard]] bool kernel_traces(KernelId kernel);

/// The kernel of that name.
[[nodiscard]] std::optional<KernelId> kernel_of(std::string_view name);

/// The argument of that name. Throws Error (exit code 3) where the kernel has none.
[[nodiscard]] const LaunchArgument& argument_of(const Launch& launch, std::string_view name);

/// Throws Error (exit code 3) where a launch does not have the arguments that its kernel declares.
void check_arguments(const Launch& launch);

}  // namespace weft

#endif
