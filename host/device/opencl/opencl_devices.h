// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_OPENCL_DEVICES_H
#define WEFT_DEVICE_OPENCL_OPENCL_DEVICES_H

#include <cstddef>
#include <string>
#include <vector>

#include "device/executor.h"
#include "device/opencl/opencl.h"

namespace weft {

/// An OpenCL device and its description.
struct OpenClDevice {
    cl::Device device;
    DeviceInfo info;
    std::size_t twins = 0;  ///< devices before it that have the same name and driver
};

/// Every device of every platform, in the loader's order; empty where there is no driver.
[[nodiscard]] std::vector<OpenClDevice> opencl_devices();

/// The device that `wanted` names: an index, or a part of the name in any case, of one that
/// can be used where there are several. Where it is empty, the first GPU, else the first
/// accelerator, else the first processor; a simulator only if nothing else is there. Devices with a
/// failure are never chosen. Throws Error (exit code 3) that says why there is none, and which
/// there are.
[[nodiscard]] OpenClDevice choose_opencl_device(const std::string& wanted);

/// Why no device can be chosen where none is named, and empty where one can.
[[nodiscard]] std::string no_opencl_device(const std::vector<OpenClDevice>& devices);

/// Whether the device interprets kernels to find errors in them (Oclgrind).
[[nodiscard]] bool is_simulator(const DeviceInfo& device);

/// Limits the threads of OpenCL drivers that run on the host (PoCL). Takes effect only before the
/// first other OpenCL call of the process.
void limit_opencl_threads(int threads);

}  // namespace weft

#endif
