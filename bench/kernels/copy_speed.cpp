// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/kernels/copy_speed.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "base/large_memory.h"
#include "base/stopwatch.h"
#if WEFT_HAS_OPENCL
#include "device/opencl/opencl_devices.h"
#endif

namespace weft::bench {
namespace {

/// Larger than the last caches of processors, and small enough for any device.
constexpr std::size_t most_bytes = std::size_t{256} << 20;
/// The first copies touch the memory for the first time.
constexpr int copies = 12;

/// Bytes per second, of the fastest copy. `copy` returns the milliseconds of one.
template <class Copy>
double fastest(std::size_t bytes, const Copy& copy) {
    double least_ms = std::numeric_limits<double>::infinity();
    for (int i = 0; i < copies; ++i) least_ms = std::min(least_ms, copy());
    return least_ms > 0.0 ? 2.0 * static_cast<double>(bytes) / (least_ms * 1e-3) : 0.0;
}

double native_speed() {
    LargeVector<std::byte> from(most_bytes);
    LargeVector<std::byte> to(most_bytes);
    constexpr std::size_t block = std::size_t{1} << 20;
    return fastest(most_bytes, [&] {
        const Stopwatch watch;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, most_bytes / block),
                          [&](const tbb::blocked_range<std::size_t>& blocks) {
                              for (std::size_t i = blocks.begin(); i != blocks.end(); ++i)
                                  std::memcpy(to.data() + i * block, from.data() + i * block,
                                              block);
                          });
        return watch.total();
    });
}

#if WEFT_HAS_OPENCL
constexpr const char* source = R"(
kernel void copy_block(global const float4* from, global float4* to) {
    const size_t i = get_global_id(0);
    to[i] = from[i];
}
)";

double opencl_speed(const DeviceInfo& info) {
    const cl::Device device = opencl_devices().at(static_cast<std::size_t>(info.index)).device;
    constexpr std::size_t group = 64;
    constexpr std::size_t item = sizeof(cl_float4);
    std::size_t bytes = most_bytes;
    while (bytes > info.max_allocation || 4 * bytes > info.memory) bytes /= 2;
    if (bytes < group * item)
        throw Error(ExitCode::device, fmt::format("{} has no memory to copy", info.name));
    try {
        const cl::Context context(device);
        const cl::CommandQueue queue(context, device, CL_QUEUE_PROFILING_ENABLE);
        const cl::Program program(context, source);
        program.build({device}, "-cl-std=CL1.2");
        cl::Kernel kernel(program, "copy_block");
        const cl::Buffer from(context, CL_MEM_READ_ONLY, bytes);
        const cl::Buffer to(context, CL_MEM_WRITE_ONLY, bytes);
        queue.enqueueFillBuffer(from, cl_float{0.0F}, 0, bytes);
        kernel.setArg(0, from);
        kernel.setArg(1, to);
        return fastest(bytes, [&] {
            cl::Event event;
            queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(bytes / item),
                                       cl::NDRange(group), nullptr, &event);
            event.wait();
            const auto begin = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
            const auto end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
            return static_cast<double>(end - begin) * 1e-6;
        });
    } catch (const cl::Error& error) {
        throw Error(ExitCode::device, fmt::format("OpenCL: copying on {} failed in {} (error {})",
                                                  info.name, error.what(), error.err()));
    }
}
#endif

}  // namespace

double copy_speed(const DeviceInfo& device) {
#if WEFT_HAS_OPENCL
    if (device.index >= 0) return opencl_speed(device);
#endif
    return native_speed();
}

}  // namespace weft::bench
