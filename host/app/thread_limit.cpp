// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/thread_limit.h"

#include <algorithm>
#include <cstddef>

namespace weft {

ThreadLimit::ThreadLimit(std::optional<std::uint32_t> threads) {
    if (!threads) return;
    constexpr auto parallelism = tbb::global_control::max_allowed_parallelism;
    // A limit above the number of processors would add threads rather than limit them.
    control_.emplace(parallelism, std::min(std::size_t{*threads},
                                           tbb::global_control::active_value(parallelism)));
}

}  // namespace weft
