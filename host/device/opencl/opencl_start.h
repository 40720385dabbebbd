// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_OPENCL_START_H
#define WEFT_DEVICE_OPENCL_OPENCL_START_H

#include <optional>

#include "base/diagnostics.h"
#include "device/opencl/compile_server.h"
#include "device/opencl/driver_fault.h"
#include "device/opencl/driver_folder.h"
#include "device/opencl/usable_drivers.h"

namespace weft {

/// What a program that may run kernels on OpenCL devices does first, before it has a thread or
/// calls OpenCL: it gives drivers a folder, tries those it does not know, opens none that fails
/// (admit_drivers), and starts the processes that compile. Warns where the cache cannot be used.
class OpenClStart {
  public:
    OpenClStart(TrialUse use, Diagnostics& diagnostics);

  private:
    DriverFolder folder_;
    std::optional<CompileServer> server_;  ///< after the trials: it opens what they admit
    std::optional<ExitWatch> exits_;       ///< trials and servers leave in their own way
};

}  // namespace weft

#endif
