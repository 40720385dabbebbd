// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_OPENCL_PROGRAM_H
#define WEFT_DEVICE_OPENCL_OPENCL_PROGRAM_H

#include <cstdint>
#include <string>

#include "device/executor.h"
#include "device/opencl/opencl.h"
#include "device/opencl/program_cache.h"

namespace weft {

/// How programs are compiled for one device.
struct ProgramSettings {
    std::uint32_t lanes = 1;
    std::uint32_t local_size = 8;
};

/// One kernel, built and ready to launch.
class OpenClProgram {
  public:
    /// Loads the kernel from `cache` or compiles `source`. `features` the kernel does not ask about
    /// do not make another variant. Throws Error (exit code 3) with the build log.
    OpenClProgram(const cl::Context& context, const cl::Device& device, const ProgramCache& cache,
                  KernelId kernel, const std::string& source, const ProgramSettings& settings,
                  std::uint32_t features);

    [[nodiscard]] cl::Kernel& kernel() noexcept { return kernel_; }
    [[nodiscard]] const KernelBuild& build() const noexcept { return build_; }

    /// To be called once, after the first launch took `launch_ms`: drivers compile at that point
    /// too, so only now the program is worth keeping.
    void keep(const ProgramCache& cache, double launch_ms);
    [[nodiscard]] bool kept() const noexcept { return kept_; }

  private:
    bool load(const cl::Context& context, const cl::Device& device, const ProgramCache& cache);
    void compile(const cl::Context& context, const cl::Device& device, const std::string& source);

    cl::Program program_;
    cl::Kernel kernel_;
    std::string key_;
    KernelBuild build_;
    bool kept_ = false;
};

}  // namespace weft

#endif
