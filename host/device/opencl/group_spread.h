// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_GROUP_SPREAD_H
#define WEFT_DEVICE_OPENCL_GROUP_SPREAD_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

namespace weft {

/// How many of the `groups` work groups of a kernel's longest launch (1 to 65535) a launch of
/// `items` work-items starts: no more than there are items, since on slow devices starting a group
/// without any costs more time than a short launch takes.
[[nodiscard]] inline std::uint32_t busy_groups(std::uint32_t groups, std::uint32_t items) {
    return std::clamp(items, 1U, groups);
}

/// The LaunchRange::spread of a launch of `groups` work groups (1 to 65535) of which some have no
/// work: coprime to their number, so that each group is taken once, and close to their golden
/// section, so that any first few of g * spread mod groups lie evenly (Steinhaus' three-gap
/// theorem). 1, which spreads nothing, for fewer than four groups.
[[nodiscard]] inline std::uint32_t group_spread(std::uint32_t groups) {
    auto spread = static_cast<std::uint32_t>(std::lround(groups * (std::numbers::phi - 1.0)));
    while (spread > 1 && std::gcd(spread, groups) != 1) --spread;
    return groups < 4 ? 1 : spread;
}

}  // namespace weft

#endif
