// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_OPENCL_EXECUTOR_H
#define WEFT_DEVICE_OPENCL_OPENCL_EXECUTOR_H

#include <memory>

#include "device/executor.h"
#include "device/opencl/opencl_devices.h"

namespace weft {

/// Runs kernels on an OpenCL device. `threads` limits BVH building (0: all cores); the driver's own
/// threads are limited by limit_opencl_threads. Honours WEFT_LANES and the program cache, and uses
/// the CompileServer where there is one.
[[nodiscard]] std::unique_ptr<Executor> make_opencl_executor(const OpenClDevice& device,
                                                             int threads);

}  // namespace weft

#endif
