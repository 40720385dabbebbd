// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_FRAME_BUDGET_H
#define WEFT_PLAN_FRAME_BUDGET_H

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace weft {

/// Gains stay within [1 / greatest_gain, greatest_gain]. At the standard threshold of 10 that is
/// 0.6 to 160 just noticeable differences: below, errors are no worse than noise; above, all tiles
/// are coarse.
inline constexpr double greatest_gain = 16.0;

/// Whether a component's threshold can still change its cost, and in which direction.
struct ThresholdScope {
    std::string component;
    bool can_save = true;   ///< some tile is sampled more densely because of its error
    bool can_spend = true;  ///< some tile is not sampled at every pixel because of its error
};

/// Keeps the time of frames near a target: one gain g per adaptive component on its threshold, and
/// after each frame g *= clamp(sqrt(t_used / t_target), 0.8, 1.25). The square root damps, so that
/// the gain settles even where cost falls faster than the threshold grows, and the clamp keeps a
/// single slow frame from spoiling the next ones.
class FrameBudget {
  public:
    /// `target_ms`: above 0; 0 or less, or not finite: no target, and all gains stay 1.
    explicit FrameBudget(double target_ms = 0.0);

    [[nodiscard]] bool has_target() const { return target_ms_ > 0.0; }
    [[nodiscard]] double target_ms() const { return target_ms_; }

    /// Factor on the threshold of a component; 1 before its first frame.
    [[nodiscard]] double gain(const std::string& component) const;

    /// Adapts the gains to the time of a frame. Those that could not change its cost stay as they
    /// are, so that none runs away while another does the work. A time that is not finite or not
    /// above 0 is ignored.
    void spend(double used_ms, std::span<const ThresholdScope> components);

  private:
    double target_ms_;
    std::map<std::string, double> gains_;
};

}  // namespace weft

#endif
