// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_TRADEOFF_PAGE_H
#define WEFT_TRADEOFF_TRADEOFF_PAGE_H

#include <string>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// The result as one HTML document: the advice, plots, tables, thumbnails and error maps, and how
/// it was measured. It needs no other file, no network and no scripts, and is well-formed XML. The
/// same result gives the same text. Numbers that are not finite are shown as missing, and texts of
/// the result are never taken for markup.
[[nodiscard]] std::string tradeoff_page(const TradeoffResult& result);

}  // namespace weft

#endif
