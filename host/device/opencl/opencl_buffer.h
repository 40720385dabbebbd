// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_OPENCL_BUFFER_H
#define WEFT_DEVICE_OPENCL_OPENCL_BUFFER_H

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/large_memory.h"
#include "device/executor.h"
#include "device/opencl/opencl.h"

namespace weft {

/// Throws a failure of OpenCL as an Error: exit code 4 where memory ran out, else 3. `action` names
/// what failed.
[[noreturn]] inline void rethrow(const cl::Error& error, const std::string& action) {
    const bool memory =
        error.err() == CL_MEM_OBJECT_ALLOCATION_FAILURE || error.err() == CL_OUT_OF_HOST_MEMORY;
    throw Error(
        memory ? ExitCode::out_of_memory : ExitCode::device,
        fmt::format("OpenCL: {} failed in {} (error {})", action, error.what(), error.err()));
}

/// Device memory; on CPU devices it is host memory.
class OpenClBuffer : public Buffer {
  public:
    /// Launches that use the buffer are in `queue`.
    OpenClBuffer(const cl::Context& context, const cl::CommandQueue& queue,
                 const DeviceInfo& device, std::size_t bytes, std::size_t& total)
        : Buffer(bytes), queue_(queue), total_(total) {
        if (device.is_cpu) host_.emplace(bytes);
        // Where memory is not mapped it should not be the host's: kernels would reach it by the
        // bus.
        const cl_mem_flags place = device.is_cpu        ? CL_MEM_USE_HOST_PTR
                                   : device.maps_memory ? CL_MEM_ALLOC_HOST_PTR
                                                        : cl_mem_flags{0};
        memory_ =
            cl::Buffer(context, CL_MEM_READ_WRITE | place, bytes, host_ ? host_->data() : nullptr);
        total_ += bytes;
    }
    ~OpenClBuffer() override {
        total_ -= bytes();
        if (!host_) return;
        try {
            // Where an error frees the buffers of a frame, launches may still use their memory.
            queue_.finish();
        } catch (const cl::Error&) {  // then the device is lost, and with it what ran there
        }
    }
    OpenClBuffer(const OpenClBuffer&) = delete;
    OpenClBuffer& operator=(const OpenClBuffer&) = delete;

    [[nodiscard]] const cl::Buffer& memory() const noexcept { return memory_; }

  private:
    cl::CommandQueue queue_;
    std::optional<LargeMemory> host_;  // before memory_, which refers to it
    cl::Buffer memory_;
    std::size_t& total_;
};

/// The OpenCL memory of a buffer of an OpenCL executor.
[[nodiscard]] inline const cl::Buffer& memory_of(const Buffer& buffer) {
    return dynamic_cast<const OpenClBuffer&>(buffer).memory();
}

}  // namespace weft

#endif
