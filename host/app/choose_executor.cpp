// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/choose_executor.h"

#include <filesystem>

#include "app/thread_limit.h"
#include "base/error.h"
#include "base/memory_limit.h"
#include "device/native/native_executor.h"
#if WEFT_HAS_OPENCL
#include "device/opencl/driver_fault.h"
#include "device/opencl/opencl_executor.h"
#include "device/opencl/usable_drivers.h"
#endif

namespace weft {
namespace {

#if WEFT_HAS_OPENCL
/// Where memory is limited, that may be why a driver fails.
std::filesystem::path unless_limited(const std::filesystem::path& mark) {
    return memory_limit() ? std::filesystem::path() : mark;
}

/// Drivers that have passed their trial may still crash when they are opened.
void expect_faults_of_opening() {
    report_driver_faults(unless_limited(opening_mark()));
}

std::unique_ptr<Executor> opencl_executor(const std::optional<std::string>& device, int threads) {
    if (threads > 0) limit_opencl_threads(threads);
    expect_faults_of_opening();
    const OpenClDevice chosen = choose_opencl_device(device.value_or(""));
    report_driver_faults(chosen.info, unless_limited(crash_mark(chosen.info.name,
                                                                chosen.info.driver, chosen.twins)));
    return make_opencl_executor(chosen, threads);
}
#else
std::unique_ptr<Executor> opencl_executor(const std::optional<std::string>&, int) {
    throw Error(ExitCode::device, "this weft was built without OpenCL, expected --backend embree");
}
#endif

std::unique_ptr<Executor> executor_of(Backend backend, const std::optional<std::string>& device,
                                      int threads) {
    if (backend == Backend::opencl) return opencl_executor(device, threads);
    return make_native_executor(
        backend == Backend::embree ? NativeTraversal::embree : NativeTraversal::own_bvh, threads);
}

}  // namespace

std::string why_no_opencl(int threads) {
#if WEFT_HAS_OPENCL
    if (threads > 0) limit_opencl_threads(threads);
    expect_faults_of_opening();
    std::string why = no_opencl_device(opencl_devices());
    if (!why.empty()) forget_driver_faults();
    return why;
#else
    static_cast<void>(threads);
    return "this weft was built without OpenCL";
#endif
}

std::unique_ptr<Executor> choose_executor(const RenderOptions& options, Diagnostics& diagnostics) {
    const int threads = options.threads ? static_cast<int>(usable_threads(*options.threads)) : 0;
    Backend backend = options.backend.value_or(Backend::opencl);
    if (!options.backend && !options.device) {
        if (const std::string why = why_no_opencl(threads); !why.empty()) {
            diagnostics.warn("", why + ", rendering with --backend embree");
            backend = Backend::embree;
        }
    }
    return executor_of(backend, options.device, threads);
}

std::vector<std::unique_ptr<Executor>> selftest_executors(const SelftestOptions& options) {
    std::vector<std::unique_ptr<Executor>> executors;
    if (options.backend) {
        executors.push_back(executor_of(*options.backend, options.device, 0));
        return executors;
    }
    for (const Backend backend : {Backend::native, Backend::embree})
        executors.push_back(executor_of(backend, std::nullopt, 0));
    if (options.device || why_no_opencl(0).empty())
        executors.push_back(executor_of(Backend::opencl, options.device, 0));
    return executors;
}

std::vector<DeviceInfo> all_devices() {
    std::vector<DeviceInfo> devices;
#if WEFT_HAS_OPENCL
    expect_faults_of_opening();
    for (const OpenClDevice& device : opencl_devices()) devices.push_back(device.info);
    for (const DriverTrial& trial : driver_trials())
        if (!trial.failure.empty()) {
            DeviceInfo& refused = devices.emplace_back();
            refused.backend = "opencl";
            refused.driver = trial.driver.place();
            refused.failure = trial.failure;
        }
#endif
    devices.push_back(native_device_info(NativeTraversal::embree));
    return devices;
}

}  // namespace weft
