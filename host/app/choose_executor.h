// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_CHOOSE_EXECUTOR_H
#define WEFT_APP_CHOOSE_EXECUTOR_H

#include <memory>
#include <string>
#include <vector>

#include "app/options.h"
#include "base/diagnostics.h"
#include "device/executor.h"

namespace weft {

/// The backend and device that the options name. Where they name no backend it is OpenCL if there
/// is any device, else Embree, and a warning says so. Throws Error (exit code 3).
[[nodiscard]] std::unique_ptr<Executor> choose_executor(const RenderOptions& options,
                                                        Diagnostics& diagnostics);

/// Why no OpenCL device can be used, on that many threads of a processor (0: all); empty where one
/// can.
[[nodiscard]] std::string why_no_opencl(int threads);

/// The executors that `weft selftest` runs on: the backend that the options name, or else the
/// OpenCL device that they name or `weft render` would choose, if there is any, and both native
/// backends. Throws Error (exit code 3).
[[nodiscard]] std::vector<std::unique_ptr<Executor>> selftest_executors(
    const SelftestOptions& options);

/// Every OpenCL device, then OpenCL drivers that could not be opened, which have a failure but no
/// name, and the Embree backend.
[[nodiscard]] std::vector<DeviceInfo> all_devices();

}  // namespace weft

#endif
