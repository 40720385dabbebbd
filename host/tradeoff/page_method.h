// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_METHOD_H
#define WEFT_TRADEOFF_PAGE_METHOD_H

#include <string>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// The section that says how everything was measured, on what machine, and how to do it again.
[[nodiscard]] std::string method_section(const TradeoffResult& result);

}  // namespace weft

#endif
