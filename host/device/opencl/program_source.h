// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_PROGRAM_SOURCE_H
#define WEFT_DEVICE_OPENCL_PROGRAM_SOURCE_H

#include <string>
#include <string_view>

namespace weft {

/// OpenCL C source of a kernel: `<name>.cl` of the embedded files, in a folder of kernels/, with
/// every `#include "kernels/<folder>/<file>"` replaced by that file, once. Where the environment
/// variable WEFT_KERNELS names a folder, the files are read from there instead. Programs are cached
/// by their source, so those of different folders are never confused. Throws Error (exit code 3)
/// for a file that is not embedded, or (exit code 2) not in the folder.
[[nodiscard]] std::string program_source(std::string_view kernel);

}  // namespace weft

#endif
