// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_PROGRAM_SOURCE_H
#define WEFT_DEVICE_OPENCL_PROGRAM_SOURCE_H

#include <string>
#include <string_view>

namespace weft {

/// OpenCL C source of a kernel: `<name>.cl` of the embedded files with every `#include "file"`
/// replaced by that file, once. Throws Error (exit code 3) for a file that is not embedded.
[[nodiscard]] std::string program_source(std::string_view kernel);

}  // namespace weft

#endif
