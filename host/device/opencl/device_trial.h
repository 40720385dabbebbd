// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_DEVICE_TRIAL_H
#define WEFT_DEVICE_OPENCL_DEVICE_TRIAL_H

#include <string>

#include "device/opencl/opencl_devices.h"

namespace weft {

/// What came of trying a device.
struct DeviceVerdict {
    std::string failure;     ///< what is wrong, in few words; empty where nothing is
    bool momentary = false;  ///< there was no memory or no space on the disk, which may change
};

/// Lets a device trace some rays whose hits are known and compile a large kernel, and looks at what
/// it says of itself. A bad driver may end the process or never return. Simulators, which take
/// minutes, count as right.
[[nodiscard]] DeviceVerdict try_device(const OpenClDevice& device);

}  // namespace weft

#endif
