// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/thread_limit.h"

#include <algorithm>
#include <cstddef>

namespace weft {

namespace {

constexpr auto parallelism = tbb::global_control::max_allowed_parallelism;

}  // namespace

std::uint32_t usable_threads(std::uint32_t wanted) {
    const std::size_t allowed = tbb::global_control::active_value(parallelism);
    return static_cast<std::uint32_t>(
        std::min(std::size_t{wanted}, std::max<std::size_t>(1, allowed)));
}

ThreadLimit::ThreadLimit(std::optional<std::uint32_t> threads) {
    // A limit above the number of processors would add threads rather than limit them.
    if (threads) control_.emplace(parallelism, usable_threads(*threads));
}

}  // namespace weft
