// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/processor_wait.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace weft {

double processor_wait_ms(pid_t process) noexcept {
    namespace fs = std::filesystem;
    std::uint64_t longest = 0;
    try {
        const fs::path threads = "/proc/" + std::to_string(process) + "/task";
        std::error_code error;
        for (fs::directory_iterator at(threads, error), end; !error && at != end;
             at.increment(error)) {
            // Linux: nanoseconds on a processor and waiting for one, and how often it got one.
            std::ifstream file(at->path() / "schedstat");
            std::uint64_t ran = 0;
            std::uint64_t waited = 0;
            if (file >> ran >> waited) longest = std::max(longest, waited);
        }
    } catch (const std::exception&) {
        return 0.0;
    }
    return static_cast<double>(longest) * 1e-6;
}

}  // namespace weft
