// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_MEASURE_POINTS_H
#define WEFT_TRADEOFF_MEASURE_POINTS_H

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tradeoff/budget_candidates.h"
#include "tradeoff/measured_image.h"
#include "tradeoff/settings_sweep.h"
#include "tradeoff/tradeoff_result.h"

namespace weft {

/// Settings of a measurement.
struct MeasurePlan {
    std::uint32_t repetitions = 5;  ///< 2 and up
    std::uint32_t seed = 0;         ///< of the first image of each setting; see image_seed
    double slow_ms = 30e3;          ///< settings whose images take longer are left out
    BudgetWish wish{};              ///< budgets for Candidate::fills_budgets
};

/// The operations that a measurement consists of.
struct Measuring {
    /// Makes an image of that seed, or its first frame alone.
    std::function<MeasuredImage(const Preset&, std::uint32_t seed, bool first_alone)> make;
    std::function<std::vector<double>(const Image&)> judge;  ///< errors, by ErrorMeasure
    /// Called before each image with the share that is done and what comes next; may throw to end
    /// the measurement.
    std::function<void(double done, const std::string& what)> report;
    /// Unbiased relative squared error, or none where the reference has no halves; may be left out.
    std::function<std::optional<ErrorEstimate>(const Image&)> unbiased{};
};

/// Seed of image `index` of a setting: `first` and the numbers after it, except reference_seeds.
[[nodiscard]] std::uint32_t image_seed(std::uint32_t first, std::uint32_t index);

/// Measures all candidates in rounds, each of which visits every one once, so that whatever slows
/// the machine for a while slows all of them alike. Before the first round each makes one frame
/// that does not count: kernels are compiled and memory is touched. A candidate that would take
/// longer than plan.slow_ms goes to `skipped`, and so do, untried, all later ones of a family that
/// took so long for a single frame. For candidates that fill budgets the time of a sample is then
/// measured by a few more frames, and their budget_candidates are measured in the rounds as well.
/// Returns all points by rising time, without images.
[[nodiscard]] std::vector<TradeoffPoint> measure_points(std::span<const Candidate> candidates,
                                                        const MeasurePlan& plan,
                                                        const Measuring& measuring,
                                                        std::vector<std::string>& skipped);

/// Marks the points that are on the front of time and that error.
void mark_front(std::vector<TradeoffPoint>& points, ErrorMeasure measure);

/// Measures every point on the front again with new seeds, in rounds, and counts how many of these
/// images lie within its intervals.
[[nodiscard]] FrontCheck check_front(std::span<const TradeoffPoint> points, ErrorMeasure measure,
                                     const MeasurePlan& plan, const Measuring& measuring,
                                     std::uint32_t rounds);

}  // namespace weft

#endif
