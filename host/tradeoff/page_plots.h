// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PAGE_PLOTS_H
#define WEFT_TRADEOFF_PAGE_PLOTS_H

#include <string>

#include "tradeoff/svg_plot.h"
#include "tradeoff/tradeoff_result.h"

namespace weft {

/// Error over time by a measure, both logarithmic: a series for each family of settings and for
/// each other renderer, points of the front ringed, the noise floor of the reference as a level.
/// In the plot of the measure that defines the front, a line joins the front.
[[nodiscard]] Plot tradeoff_plot(const TradeoffResult& result, ErrorMeasure measure);

/// The section of the page with a large plot of the chosen measure and small ones of the others.
[[nodiscard]] std::string plots_section(const TradeoffResult& result);

}  // namespace weft

#endif
