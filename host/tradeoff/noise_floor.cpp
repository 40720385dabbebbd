// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/noise_floor.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "tradeoff/page_values.h"

namespace weft {

bool within_floor(const TradeoffPoint& point, const TradeoffResult& result) {
    return error_of(point, result.measure).median <=
           error_of(result.reference.noise_floor, result.measure);
}

std::vector<const TradeoffPoint*> points_within_floor(const TradeoffResult& result) {
    std::vector<const TradeoffPoint*> points;
    for (const TradeoffPoint& point : result.points)
        if (within_floor(point, result)) points.push_back(&point);
    return points;
}

std::string floor_sentence(const TradeoffResult& result) {
    constexpr std::size_t most = 8;
    const double floor = error_of(result.reference.noise_floor, result.measure);
    if (!std::isfinite(floor)) return {};
    const std::string name =
        fmt::format("the floor, {} {}", label(result.measure), error_figure(result.measure, floor));
    const std::vector<const TradeoffPoint*> points = points_within_floor(result);
    if (points.empty())
        return fmt::format("No setting is within {}: the noise of the reference hides none.", name);
    std::string names;
    for (std::size_t i = 0; i < points.size() && i < most; ++i)
        names += (i > 0 ? ", " : "") + points[i]->name;
    if (points.size() > most) names += fmt::format(" and {} more", points.size() - most);
    return fmt::format("Within {}, where comparing says nothing: {}.", name, names);
}

}  // namespace weft
