// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_COMPILE_WORKERS_H
#define WEFT_DEVICE_OPENCL_COMPILE_WORKERS_H

#include <optional>

#include "device/opencl/compile_request.h"

namespace weft {

/// Compiles the programs of a request in processes that are forked for it, and waits for their end.
/// A program that does not build, or whose process ended early, has no time in the result. Returns
/// nothing where the other end of the socket `client` was closed meanwhile; the processes have
/// ended then, too. May only be called where no thread and no OpenCL has ever been used.
[[nodiscard]] std::optional<CompileTimes> compile_in_workers(const CompileRequest& request,
                                                             int client);

}  // namespace weft

#endif
