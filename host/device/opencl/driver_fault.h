// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_DRIVER_FAULT_H
#define WEFT_DEVICE_OPENCL_DRIVER_FAULT_H

#include <filesystem>

#include "device/executor.h"

namespace weft {

/// From now on a fault outside of this program's own code (a wild pointer, an abort) counts as one
/// of the driver of that device: the program then ends with exit code 3 and one line that says so,
/// in place of a signal, and leaves the empty file `mark`, where that is not empty. Faults of the
/// program itself end it as ever. May be called again, for another device. Where the folder that
/// drivers use is full, the line says that, and there is no mark: the driver could not help it.
void report_driver_faults(const DeviceInfo& device, const std::filesystem::path& mark);

/// While one lives, an exit of the process is a fault of the driver as well: compilers of drivers
/// exit when they fail, and nothing else of the program does.
class ExitWatch {
  public:
    ExitWatch() noexcept;
    ~ExitWatch();
    ExitWatch(const ExitWatch&) = delete;
    ExitWatch& operator=(const ExitWatch&) = delete;
};

}  // namespace weft

#endif
