// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/choose_executor.h"

#include "base/error.h"
#include "device/native/native_executor.h"
#if WEFT_HAS_OPENCL
#include "device/opencl/opencl_executor.h"
#endif

namespace weft {
namespace {

#if WEFT_HAS_OPENCL
std::unique_ptr<Executor> opencl_executor(const RenderOptions& options, int threads) {
    if (threads > 0) limit_opencl_threads(threads);
    return make_opencl_executor(choose_opencl_device(options.device.value_or("")), threads);
}

bool has_opencl_device(int threads) {
    if (threads > 0) limit_opencl_threads(threads);
    return !opencl_devices().empty();
}
#else
std::unique_ptr<Executor> opencl_executor(const RenderOptions&, int) {
    throw Error(ExitCode::device, "this weft was built without OpenCL, expected --backend embree");
}

bool has_opencl_device(int) {
    return false;
}
#endif

}  // namespace

std::unique_ptr<Executor> choose_executor(const RenderOptions& options, Diagnostics& diagnostics) {
    const int threads = static_cast<int>(options.threads.value_or(0));
    Backend backend = options.backend.value_or(Backend::opencl);
    if (!options.backend && !options.device && !has_opencl_device(threads)) {
        diagnostics.warn("", "no OpenCL device was found, rendering with --backend embree");
        backend = Backend::embree;
    }
    if (backend == Backend::opencl) return opencl_executor(options, threads);
    return make_native_executor(
        backend == Backend::embree ? NativeTraversal::embree : NativeTraversal::own_bvh, threads);
}

std::vector<DeviceInfo> all_devices() {
    std::vector<DeviceInfo> devices;
#if WEFT_HAS_OPENCL
    for (const OpenClDevice& device : opencl_devices()) devices.push_back(device.info);
#endif
    devices.push_back(native_device_info(NativeTraversal::embree));
    return devices;
}

}  // namespace weft
