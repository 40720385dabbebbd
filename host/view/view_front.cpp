// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_front.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "tradeoff/pareto_front.h"

namespace weft {
namespace {

// The first warms up, and the last is judged.
constexpr std::size_t rounds = 3;

nlohmann::json figure(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

double mean_of(const std::vector<double>& values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

ViewFront::ViewFront(std::vector<ViewCandidate> candidates) {
    for (ViewCandidate& candidate : candidates) points_.push_back({std::move(candidate)});
}

std::size_t ViewFront::steps() const {
    return rounds * points_.size();
}

std::optional<ViewFront::Step> ViewFront::next() const {
    if (step_ >= steps()) return {};
    const std::size_t round = step_ / points_.size();
    return Step{step_ % points_.size(), round > 0, round + 1 == rounds};
}

void ViewFront::took(double ms, double error) {
    const std::optional<Step> step = next();
    if (!step) return;
    Point& point = points_[step->point];
    if (step->counts) point.ms.push_back(ms);
    if (step->judged) point.error = error;
    ++step_;
}

double ViewFront::done() const {
    return points_.empty() ? 1.0 : static_cast<double>(step_) / static_cast<double>(steps());
}

nlohmann::json ViewFront::json(bool running, std::optional<std::size_t> shown) const {
    std::vector<CostAndError> costs;
    for (const Point& point : points_) costs.push_back({mean_of(point.ms), point.error});
    const std::vector<bool> on_front = pareto_front(costs);
    nlohmann::json points = nlohmann::json::array();
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const std::vector<double>& ms = points_[i].ms;
        if (ms.empty()) continue;
        points.push_back({{"index", i},
                          {"name", points_[i].candidate.name},
                          {"ms", figure(costs[i].cost)},
                          {"low_ms", *std::min_element(ms.begin(), ms.end())},
                          {"high_ms", *std::max_element(ms.begin(), ms.end())},
                          {"error", figure(costs[i].error)},
                          {"on_front", static_cast<bool>(on_front[i])},
                          {"shown", shown == i}});
    }
    return {{"done", done()}, {"running", running}, {"floor", figure(floor_)}, {"points", points}};
}

}  // namespace weft
