// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_DRIVER_FAULT_H
#define WEFT_DEVICE_OPENCL_DRIVER_FAULT_H

#include <signal.h>

#include <array>
#include <filesystem>

#include "base/error.h"
#include "device/executor.h"

namespace weft {

/// From now on a fault outside of this program's own code (a wild pointer, an abort) counts as one
/// of an OpenCL driver: the program then ends with exit code 3 and one line that says so, in place
/// of a signal. Faults of the program itself, exceptions that nobody catches among them, end it as
/// ever. The empty file `mark` is left, where that is not empty. Where the folder that drivers use
/// is full, the line says that instead, and there is no mark.
void report_driver_faults(const std::filesystem::path& mark);

/// The same, now that a device has been chosen, whose driver the line names. May be called again,
/// for another device.
void report_driver_faults(const DeviceInfo& device, const std::filesystem::path& mark);

/// No driver is in use after all: faults end the program as if none had ever been opened.
void forget_driver_faults() noexcept;

/// The command is done and the program ends with that code, whatever drivers do from now on while
/// they are unloaded.
void ignore_driver_faults(ExitCode code) noexcept;

/// While one lives, drivers are opened. At its end, handlers of signals that LLVM libraries of
/// theirs have installed give way to those that were there before, for good. Drivers keep handlers
/// of their own: PoCL needs one where kernels divide by zero.
class DriverOpening {
  public:
    DriverOpening() noexcept;
    ~DriverOpening();
    DriverOpening(const DriverOpening&) = delete;
    DriverOpening& operator=(const DriverOpening&) = delete;

  private:
    std::array<struct sigaction, NSIG> before_{};  ///< by signal
};

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
