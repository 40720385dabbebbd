// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_EQUAL_TIME_H
#define WEFT_TRADEOFF_PAGE_EQUAL_TIME_H

#include <string>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// The section that compares other renderers with Weft's best setting for the same time, by a table
/// and thumbnails for each of their budgets; empty where there are no other renderers and no notes
/// on them.
[[nodiscard]] std::string equal_time_section(const TradeoffResult& result);

}  // namespace weft

#endif
