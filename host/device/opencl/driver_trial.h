// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_DRIVER_TRIAL_H
#define WEFT_DEVICE_OPENCL_DRIVER_TRIAL_H

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "device/opencl/driver_files.h"

namespace weft {

/// What came of trying a device.
struct DeviceTrial {
    std::string name;     ///< DeviceInfo::name
    std::string driver;   ///< DeviceInfo::driver
    std::string failure;  ///< what is wrong, in few words; empty where nothing is
};

/// What came of opening a driver and trying its devices.
struct DriverTrial {
    DriverFile driver;
    std::string failure;  ///< of opening it and listing its devices; empty where that works
    std::vector<DeviceTrial> devices;
    /// A failure is not the driver's, so that it may pass at another time: there was no memory, no
    /// space on the disk or no process for it, or somebody else has ended its trial.
    bool momentary = false;
};

/// Opens every driver and tries its devices (try_device), each driver in a process of its own and
/// all at once, so that one that crashes, hangs or ends the process is only reported. A driver has
/// `seconds` until it has listed its devices and tried the first, and again for each that follows;
/// the time for which it waits for a processor does not count, up to twice as long. After a device
/// that takes longer, the others have two fifths of it each, and after two no more are tried.
/// Forks, so it must be called before the process has a thread or has called OpenCL.
/// `cache_folder`: of list_drivers.
[[nodiscard]] std::vector<DriverTrial> try_drivers(std::span<const DriverFile> drivers,
                                                   const std::filesystem::path& cache_folder,
                                                   double seconds);

}  // namespace weft

#endif
