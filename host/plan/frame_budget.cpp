// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/frame_budget.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr double slowest_fall = 0.8;
constexpr double fastest_rise = 1.25;

bool is_time(double ms) {
    return std::isfinite(ms) && ms > 0.0;
}

}  // namespace

FrameBudget::FrameBudget(double target_ms) : target_ms_(is_time(target_ms) ? target_ms : 0.0) {}

double FrameBudget::gain(const std::string& component) const {
    const auto found = gains_.find(component);
    return found == gains_.end() ? 1.0 : found->second;
}

void FrameBudget::spend(double used_ms, std::span<const ThresholdScope> components) {
    if (!has_target() || !is_time(used_ms)) return;
    // A root of each, because the quotient of the times may overflow.
    const double step =
        std::clamp(std::sqrt(used_ms) / std::sqrt(target_ms_), slowest_fall, fastest_rise);
    for (const ThresholdScope& scope : components) {
        if (step > 1.0 ? !scope.can_save : !scope.can_spend) continue;
        double& gain = gains_.try_emplace(scope.component, 1.0).first->second;
        gain = std::clamp(gain * step, 1.0 / greatest_gain, greatest_gain);
    }
}

}  // namespace weft
