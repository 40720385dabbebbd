// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_MEASURE_POINTS_H
#define WEFT_TRADEOFF_MEASURE_POINTS_H

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tradeoff/budget_candidates.h"
#include "tradeoff/measured_picture.h"
#include "tradeoff/settings_sweep.h"
#include "tradeoff/tradeoff_result.h"

namespace weft {

/// How a measurement goes.
struct MeasurePlan {
    std::uint32_t repetitions = 5;  ///< 2 and up
    std::uint32_t seed = 0;         ///< of the first picture of each; those that follow have others
    double slow_ms = 30e3;          ///< settings whose pictures take longer are left out
    BudgetWish wish{};              ///< what those that fill budgets are measured for besides
};

/// What it needs done.
struct Measuring {
    /// Makes a picture of that seed, or its first frame alone.
    std::function<MeasuredPicture(const Preset&, std::uint32_t seed, bool first_alone)> make;
    std::function<std::vector<double>(const Image&)> judge;  ///< errors, by ErrorMeasure
    /// Told, before each picture, of what share is done and what comes; may throw to end it all.
    std::function<void(double done, const std::string& what)> report;
};

/// Seed of picture `index` of a setting: `first` and the numbers after it, without that of
/// references.
[[nodiscard]] std::uint32_t picture_seed(std::uint32_t first, std::uint32_t index);

/// Measures all candidates in rounds, each of which visits every one once, so that whatever slows
/// the machine for a while slows all of them alike. Before the first round each makes one frame
/// that does not count: kernels are compiled and memory is touched. One that would take longer than
/// plan.slow_ms goes to `skipped`, and so does, untried, all of a family that took so long for a
/// single frame. Those that fill budgets then say by a few frames more how long a sample takes, and
/// come into the rounds with budget_candidates too. Returns all by rising time, without pictures.
[[nodiscard]] std::vector<TradeoffPoint> measure_points(std::span<const Candidate> candidates,
                                                        const MeasurePlan& plan,
                                                        const Measuring& measuring,
                                                        std::vector<std::string>& skipped);

/// Says of each point whether it is on the front of time and that error.
void mark_front(std::vector<TradeoffPoint>& points, ErrorMeasure measure);

/// Makes every point on the front again with new seeds, in rounds, and counts how many of these
/// pictures lie within its intervals.
[[nodiscard]] FrontCheck check_front(std::span<const TradeoffPoint> points, ErrorMeasure measure,
                                     const MeasurePlan& plan, const Measuring& measuring,
                                     std::uint32_t rounds);

}  // namespace weft

#endif
