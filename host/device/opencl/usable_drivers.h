// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_USABLE_DRIVERS_H
#define WEFT_DEVICE_OPENCL_USABLE_DRIVERS_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "device/opencl/driver_trial.h"

namespace weft {

enum class TrialUse : std::uint8_t {
    remembered,  ///< of drivers that have been tried before and are as they were
    fresh,       ///< all drivers are tried again
};

/// Lets this process open only drivers that have stood their trial (try_drivers), and remembers
/// what came of it in the cache folder, so that a driver is tried once until it changes. Must be
/// called before the process has a thread or has called OpenCL.
void admit_drivers(TrialUse use);

/// What came of the trials; empty before admit_drivers.
[[nodiscard]] const std::vector<DriverTrial>& driver_trials() noexcept;

/// What admit_drivers has found wrong with the device of that name and driver that comes after
/// `before` others which share both; empty where nothing is known.
[[nodiscard]] std::string known_failure(const std::string& name, const std::string& driver,
                                        std::size_t before);

/// A file whose presence says that a device's driver has crashed (report_driver_faults). Trials
/// that are fresh begin without it. Empty where there is no cache folder. Devices are told apart as
/// by known_failure.
[[nodiscard]] std::filesystem::path crash_mark(const std::string& name, const std::string& driver,
                                               std::size_t before);

/// Likewise, for a crash while drivers are opened, before a device is chosen: all of them are tried
/// again then.
[[nodiscard]] std::filesystem::path opening_mark();

/// What is wrong with drivers that could not be opened, for errors; empty where all could.
[[nodiscard]] std::string refused_drivers();

}  // namespace weft

#endif
