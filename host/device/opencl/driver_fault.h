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
/// program itself end it as ever. May be called again, for another device.
void report_driver_faults(const DeviceInfo& device, const std::filesystem::path& mark);

}  // namespace weft

#endif
