// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/opencl_start.h"

#include <fmt/format.h>

#include "base/cache_folder.h"

namespace weft {

OpenClStart::OpenClStart(TrialUse use, Diagnostics& diagnostics) : folder_(default_cache_folder()) {
    admit_drivers(use);
    server_.emplace();
    exits_.emplace();
    if (!folder_.trouble().empty())
        diagnostics.warn(default_cache_folder().string(),
                         fmt::format("cannot be used ({}), so that every run compiles its kernels",
                                     folder_.trouble()));
}

}  // namespace weft
