// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_PROGRAM_RECIPE_H
#define WEFT_DEVICE_OPENCL_PROGRAM_RECIPE_H

#include <cstdint>
#include <string>

#include "device/executor.h"
#include "device/opencl/opencl.h"

namespace weft {

/// How programs are compiled for one device.
struct ProgramSettings {
    std::uint32_t lanes = 1;
    std::uint32_t local_size = 8;
    std::uint32_t chunk_factor = 1;  ///< work-items of a launch, as a multiple of kernel_chunk
};

/// Everything that is needed to compile the program of one kernel.
struct ProgramRecipe {
    std::string name;  ///< of the kernel
    std::string source;
    std::string options;
    std::string key;                                ///< in the ProgramCache: see program_key
    std::uint32_t global_size = 0, local_size = 0;  ///< of every launch
};

/// Work-items of every launch of a kernel, a multiple of the local size. It is always the same,
/// since drivers such as PoCL compile anew for each launch size.
[[nodiscard]] std::uint32_t launch_size(KernelId kernel, const ProgramSettings& settings);

/// The key in the ProgramCache of a program of this source and these options; differs with the
/// device and its driver. Throws cl::Error.
[[nodiscard]] std::string program_key(const cl::Device& device, const std::string& source,
                                      const std::string& options);

/// How `kernel` is built for `device`. `features` that it does not depend on do not make another
/// variant. Throws Error as program_source does, and cl::Error.
[[nodiscard]] ProgramRecipe program_recipe(const cl::Device& device, KernelId kernel,
                                           const ProgramSettings& settings, std::uint32_t features);

}  // namespace weft

#endif
