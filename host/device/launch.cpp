// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/launch.h"

#include <fmt/format.h>

#include "base/error.h"

namespace weft {

void ArgumentBinder::add_required(std::string_view name, Buffer* buffer) {
    if (buffer == nullptr)
        throw Error(ExitCode::device, fmt::format("kernel {} was launched without its buffer {}",
                                                  kernel_name(kernel_), name));
    arguments_.push_back({buffer, nullptr, 0});
}

}  // namespace weft
