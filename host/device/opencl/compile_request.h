// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_COMPILE_REQUEST_H
#define WEFT_DEVICE_OPENCL_COMPILE_REQUEST_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "device/opencl/program_recipe.h"

namespace weft {

/// Programs that the CompileServer is to compile into a ProgramCache.
struct CompileRequest {
    std::uint32_t device = 0;   ///< index in opencl_devices(); keys verify that it is the same one
    std::uint32_t workers = 1;  ///< processes at once, at most
    std::string cache_folder;   ///< absolute
    std::vector<ProgramRecipe> programs;
};

/// Time of each program of a request, in milliseconds; empty where it is not in the cache.
using CompileTimes = std::vector<std::optional<double>>;

/// Encodes as bytes, for a process on the same machine.
[[nodiscard]] std::vector<std::byte> encode(const CompileRequest& request);
[[nodiscard]] std::vector<std::byte> encode(const CompileTimes& times);

/// Decodes what was encoded; empty where the bytes are not of that form, and then nothing large is
/// allocated.
[[nodiscard]] std::optional<CompileRequest> decode_request(std::span<const std::byte> bytes);
/// The same for the times of a request with so many programs.
[[nodiscard]] std::optional<CompileTimes> decode_times(std::span<const std::byte> bytes,
                                                       std::size_t programs);

}  // namespace weft

#endif
