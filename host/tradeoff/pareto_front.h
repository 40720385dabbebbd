// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PARETO_FRONT_H
#define WEFT_TRADEOFF_PARETO_FRONT_H

#include <span>
#include <vector>

namespace weft {

/// The time and the error of a setting.
struct CostAndError {
    double cost = 0.0;
    double error = 0.0;
};

/// For each point, whether it is on the Pareto front: no other point is at most as costly and at
/// most as wrong, and better in one of both. Of equal points all are on the front or none. A point
/// with a value that is not finite is not on it, and beats none.
[[nodiscard]] std::vector<bool> pareto_front(std::span<const CostAndError> points);

}  // namespace weft

#endif
