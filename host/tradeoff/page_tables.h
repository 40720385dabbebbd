// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_TABLES_H
#define WEFT_TRADEOFF_PAGE_TABLES_H

#include <string>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// The section with the table of the front, and of the reference with its noise floor.
[[nodiscard]] std::string front_section(const TradeoffResult& result);

/// The section with all points, folded.
[[nodiscard]] std::string points_section(const TradeoffResult& result);

}  // namespace weft

#endif
