// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_COMPILE_AHEAD_H
#define WEFT_DEVICE_OPENCL_COMPILE_AHEAD_H

#include <cstdint>
#include <vector>

#include "device/opencl/compile_request.h"
#include "device/opencl/program_cache.h"

namespace weft {

/// Lets the CompileServer compile those of `programs` that are not in `cache` into it, in at most
/// `processes` processes at once. Returns the time of each program; empty where it was there
/// already, or where the caller has to compile it, as always where there is no server or too little
/// for it to do.
[[nodiscard]] CompileTimes compile_ahead(const std::vector<ProgramRecipe>& programs,
                                         const DeviceInfo& device, const ProgramCache& cache,
                                         std::uint32_t processes);

}  // namespace weft

#endif
