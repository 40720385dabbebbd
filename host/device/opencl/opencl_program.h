// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_OPENCL_PROGRAM_H
#define WEFT_DEVICE_OPENCL_OPENCL_PROGRAM_H

#include <optional>
#include <string>

#include "device/executor.h"
#include "device/opencl/opencl.h"
#include "device/opencl/program_cache.h"
#include "device/opencl/program_recipe.h"

namespace weft {

/// One kernel, built and ready to launch.
class OpenClProgram {
  public:
    /// Loads the kernel from `cache` or compiles it. `compiled_ms`: time for which it was just
    /// compiled into the cache, if it was. Throws Error (exit code 3) with the first error of the
    /// build log, all of which it leaves in the cache folder.
    OpenClProgram(const cl::Context& context, const cl::Device& device, const ProgramCache& cache,
                  const KernelUse& use, const ProgramRecipe& recipe,
                  std::optional<double> compiled_ms);

    [[nodiscard]] cl::Kernel& kernel() noexcept { return kernel_; }
    [[nodiscard]] const KernelBuild& build() const noexcept { return build_; }

    /// Stores the program in the cache. To be called once, after the first launch took `launch_ms`:
    /// drivers compile in that launch, too, so the binary is complete only now.
    void keep(const ProgramCache& cache, double launch_ms);
    [[nodiscard]] bool kept() const noexcept { return kept_; }

  private:
    bool load(const cl::Context& context, const cl::Device& device, const ProgramCache& cache);
    void compile(const cl::Context& context, const cl::Device& device, const ProgramCache& cache,
                 const std::string& source);
    /// Why the program does not build, in one line.
    [[nodiscard]] std::string build_failure(const cl::Device& device,
                                            const ProgramCache& cache) const;

    cl::Program program_;
    cl::Kernel kernel_;
    std::string key_;
    KernelBuild build_;
    bool cached_ = false;  ///< was loaded from the cache, so it need not be stored
    bool kept_ = false;
};

}  // namespace weft

#endif
