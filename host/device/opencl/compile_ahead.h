// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_COMPILE_AHEAD_H
#define WEFT_DEVICE_OPENCL_COMPILE_AHEAD_H

#include <cstdint>
#include <vector>

#include "device/opencl/compile_request.h"
#include "device/opencl/program_cache.h"

namespace weft {

/// Has the CompileServer compile into `cache` what is missing there of `programs`, in at most so
/// many processes at once. What each program took; empty where it was there, or is left to the
/// caller, as all are where there is no server or too little for it to do.
[[nodiscard]] CompileTimes compile_ahead(const std::vector<ProgramRecipe>& programs,
                                         const DeviceInfo& device, const ProgramCache& cache,
                                         std::uint32_t processes);

}  // namespace weft

#endif
