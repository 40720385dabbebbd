// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_EQUAL_TIME_H
#define WEFT_TRADEOFF_PAGE_EQUAL_TIME_H

#include <string>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// The section that sets other renderers beside Weft's best setting for the same time, a table and
/// thumbnails for each of their budgets; empty where there are no others and nothing to say of
/// them.
[[nodiscard]] std::string equal_time_section(const TradeoffResult& result);

}  // namespace weft

#endif
