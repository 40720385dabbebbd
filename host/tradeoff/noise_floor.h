// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_NOISE_FLOOR_H
#define WEFT_TRADEOFF_NOISE_FLOOR_H

#include <string>
#include <vector>

#include "tradeoff/tradeoff_result.h"

namespace weft {

/// Whether the median error of a point, by the measure of the result, is no larger than that of one
/// half of the reference's samples against the other, so that comparing it with others says
/// nothing. False where either is not known.
[[nodiscard]] bool within_floor(const TradeoffPoint& point, const TradeoffResult& result);

/// The points of the result that are within the floor, by rising time.
[[nodiscard]] std::vector<const TradeoffPoint*> points_within_floor(const TradeoffResult& result);

/// One sentence that names these points, at most eight of them, or says that there are none. Empty
/// where the floor is not known.
[[nodiscard]] std::string floor_sentence(const TradeoffResult& result);

}  // namespace weft

#endif
