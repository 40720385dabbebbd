// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/pareto_front.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace weft {

std::vector<bool> pareto_front(std::span<const CostAndError> points) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].cost) && std::isfinite(points[i].error)) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (points[a].cost != points[b].cost) return points[a].cost < points[b].cost;
        return points[a].error < points[b].error;
    });
    std::vector<bool> on_front(points.size(), false);
    double least = std::numeric_limits<double>::infinity();
    double its_cost = 0.0;
    for (const std::size_t index : order) {
        const CostAndError& point = points[index];
        const bool equal = point.error == least && point.cost == its_cost;
        if (point.error >= least && !equal) continue;
        on_front[index] = true;
        least = point.error;
        its_cost = point.cost;
    }
    return on_front;
}

}  // namespace weft
