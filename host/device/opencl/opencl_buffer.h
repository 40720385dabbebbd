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
    OpenClBuffer(const cl::Context& context, bool on_host, std::size_t bytes, std::size_t& total)
        : Buffer(bytes), total_(total) {
        if (on_host) host_.emplace(bytes);
        memory_ = cl::Buffer(
            context, CL_MEM_READ_WRITE | (on_host ? CL_MEM_USE_HOST_PTR : CL_MEM_ALLOC_HOST_PTR),
            bytes, on_host ? host_->data() : nullptr);
        total_ += bytes;
    }
    ~OpenClBuffer() override { total_ -= bytes(); }
    OpenClBuffer(const OpenClBuffer&) = delete;
    OpenClBuffer& operator=(const OpenClBuffer&) = delete;

    [[nodiscard]] const cl::Buffer& memory() const noexcept { return memory_; }

  private:
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
