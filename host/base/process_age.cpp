// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/process_age.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>

namespace weft {
namespace {

double milliseconds_of(clockid_t clock) {
    timespec now{};
    if (::clock_gettime(clock, &now) != 0) return 0.0;
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

/// When the process was started, in milliseconds after the system was, which Linux tells in ticks.
std::optional<double> start_ms() {
    constexpr int fields_before = 19;  // of starttime, counted from the state that follows the name
    std::ifstream file("/proc/self/stat");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t name_end = text.rfind(')');  // the name may hold anything
    const long ticks_per_second = ::sysconf(_SC_CLK_TCK);
    if (name_end == std::string::npos || ticks_per_second <= 0) return {};
    std::istringstream fields(text.substr(name_end + 1));
    std::string field;
    for (int i = 0; i < fields_before; ++i) fields >> field;
    std::uint64_t ticks = 0;
    if (!(fields >> ticks)) return {};
    // Ticks are rounded down: on average the process is half of one younger.
    return (static_cast<double>(ticks) + 0.5) * 1e3 / static_cast<double>(ticks_per_second);
}

}  // namespace

double process_age_ms() {
    const double used = milliseconds_of(CLOCK_PROCESS_CPUTIME_ID);
#ifdef CLOCK_BOOTTIME
    if (const std::optional<double> start = start_ms())
        return std::max(milliseconds_of(CLOCK_BOOTTIME) - *start, 0.0);
#endif
    return used;
}

}  // namespace weft
