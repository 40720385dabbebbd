// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/boot_id.h"

#include <unistd.h>

#include <array>
#include <fstream>

namespace weft {

std::string boot_id() {
    std::string id;
    if (std::getline(std::ifstream("/proc/sys/kernel/random/boot_id") >> std::ws, id)) return id;
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace weft
