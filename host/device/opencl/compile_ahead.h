// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_COMPILE_AHEAD_H
#define WEFT_DEVICE_OPENCL_COMPILE_AHEAD_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "device/opencl/compile_history.h"
#include "device/opencl/compile_request.h"
#include "device/opencl/program_cache.h"

namespace weft {

/// Called while programs are compiled: how many, and milliseconds until all are.
using CompileWatch = std::function<void(std::size_t programs, double left_ms)>;

/// Lets the CompileServer compile those of `programs` that are not in `cache` into it, in at most
/// `processes` processes at once. Returns the time of each program; empty where it was there
/// already, or where the caller has to compile it, as always where there is no server or too little
/// for it to do. Adds the times to `history`, by which it tells `watch`, if given, what is left.
[[nodiscard]] CompileTimes compile_ahead(const std::vector<ProgramRecipe>& programs,
                                         const DeviceInfo& device, const ProgramCache& cache,
                                         std::uint32_t processes, CompileHistory& history,
                                         const CompileWatch& watch);

}  // namespace weft

#endif
