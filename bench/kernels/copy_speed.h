// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_KERNELS_COPY_SPEED_H
#define WEFT_BENCH_KERNELS_COPY_SPEED_H

#include "device/executor.h"

namespace weft::bench {

/// Bytes per second that the device moves between its memory and its processors: the fastest of
/// several copies of blocks that are larger than caches, each byte read once and written once
/// (STREAM's "copy", McCalpin 1995). An OpenCL device runs a kernel of its own for that, and native
/// backends the threads that they have. Throws Error (exit code 3) where the device fails.
[[nodiscard]] double copy_speed(const DeviceInfo& device);

}  // namespace weft::bench

#endif
