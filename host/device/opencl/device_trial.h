// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_DEVICE_TRIAL_H
#define WEFT_DEVICE_OPENCL_DEVICE_TRIAL_H

#include <string>

#include "device/opencl/opencl_devices.h"

namespace weft {

/// Lets a device trace some rays whose hits are known and compile a large kernel, and looks at what
/// it says of itself. Returns what is wrong, in few words, or nothing. A bad driver may end the
/// process or never return. Simulators, which take minutes, count as right.
[[nodiscard]] std::string try_device(const OpenClDevice& device);

}  // namespace weft

#endif
