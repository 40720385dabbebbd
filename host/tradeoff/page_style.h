// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_STYLE_H
#define WEFT_TRADEOFF_PAGE_STYLE_H

#include <string_view>

namespace weft {

/// CSS of a page, after plot_style, whose colours it uses.
[[nodiscard]] std::string_view page_style();

}  // namespace weft

#endif
