// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/measure_points.h"

#include <algorithm>
#include <array>
#include <set>

#include "tradeoff/pareto_front.h"
#include "tradeoff/prediction_interval.h"
#include "tradeoff/reference_images.h"
#include "tradeoff/time_spread.h"

namespace weft {
namespace {

// Number of frames by which the time of a frame that is not the first is measured.
constexpr std::uint32_t probe_frames = 4;

struct Entrant {
    Candidate candidate;
    double expected_ms;
};

/// Milliseconds that an image takes, by its first frame. A frame that seems slow is made again, so
/// that compiling does not count.
double expected_ms(const Candidate& candidate, const MeasurePlan& plan, const Measuring& measuring,
                   double& frame_ms) {
    double expected = 0.0;
    for (int attempt = 0; attempt < 2; ++attempt) {
        const MeasuredImage first = measuring.make(candidate.preset, plan.seed, true);
        frame_ms = (first.ms - first.denoise_ms) / std::max(1U, first.frames);
        expected = frame_ms * candidate.preset.samples + first.denoise_ms;
        if (expected <= plan.slow_ms) break;
    }
    return expected;
}

std::vector<Entrant> warm_up(std::span<const Candidate> candidates, const MeasurePlan& plan,
                             const Measuring& measuring, std::vector<std::string>& skipped) {
    std::vector<Entrant> entrants;
    std::set<std::string> slow_families;
    for (const Candidate& candidate : candidates) {
        measuring.report(0.0, "first frame of " + candidate.name);
        double frame_ms = 0.0;
        const bool barred = slow_families.contains(candidate.family);
        const double expected = barred ? 0.0 : expected_ms(candidate, plan, measuring, frame_ms);
        if (frame_ms > plan.slow_ms) slow_families.insert(candidate.family);
        if (barred || expected > plan.slow_ms)
            skipped.push_back(candidate.name);
        else
            entrants.push_back({candidate, expected});
    }
    return entrants;
}

/// Adds the budget_candidates of those entrants that fill budgets.
void fill_budgets(std::vector<Entrant>& entrants, const MeasurePlan& plan,
                  const Measuring& measuring) {
    double longest = 0.0;
    for (const double budget : plan.wish.budgets_ms) longest = std::max(longest, budget);
    std::set<std::string> known;
    for (const Entrant& entrant : entrants) known.insert(entrant.candidate.name);
    const std::size_t count = entrants.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Entrant base = entrants[i];
        const double frame_ms = base.expected_ms / base.candidate.preset.samples;
        if (!base.candidate.fills_budgets || probe_frames * frame_ms > longest) continue;
        measuring.report(0.0, "frames of " + base.candidate.name);
        const Candidate probe = with_samples(base.candidate, probe_frames);
        const MeasuredImage made = measuring.make(probe.preset, plan.seed, false);
        const double sample_ms = (made.ms - made.denoise_ms) / std::max(1U, made.frames);
        for (Candidate& candidate :
             budget_candidates(base.candidate, sample_ms, plan.wish, made.denoise_ms)) {
            const double expected = sample_ms * candidate.preset.samples + made.denoise_ms;
            if (expected <= plan.slow_ms && known.insert(candidate.name).second)
                entrants.push_back({std::move(candidate), expected});
        }
    }
}

Interval interval_of(const std::vector<std::vector<double>>& runs, std::size_t measure) {
    std::vector<double> values;
    for (const std::vector<double>& run : runs) values.push_back(run.at(measure));
    // The bias may be near 0, where logarithms would scatter without limit.
    return prediction_interval(values, 0.95,
                               measure == static_cast<std::size_t>(ErrorMeasure::bias)
                                   ? IntervalScale::linear
                                   : IntervalScale::logarithmic);
}

void summarize(TradeoffPoint& point, const TimeSpread& spread) {
    point.ms = time_interval(point.runs_ms, spread);
    for (std::size_t measure = 0; measure < error_measures; ++measure)
        point.errors.push_back(interval_of(point.runs_errors, measure));
    if (!point.runs_unbiased.empty()) point.unbiased_relmse = mean_estimate(point.runs_unbiased);
}

bool within(const Interval& interval, double value) {
    return value >= interval.low && value <= interval.high;
}

}  // namespace

std::uint32_t image_seed(std::uint32_t first, std::uint32_t index) {
    // Seeds wrap around at 32 bits, so the distances from `first` are compared.
    std::array<std::uint32_t, reference_seeds.size()> left_out = reference_seeds;
    for (std::uint32_t& seed : left_out) seed -= first;
    std::sort(left_out.begin(), left_out.end());
    for (const std::uint32_t distance : left_out)
        if (distance <= index) ++index;
    return first + index;
}

std::vector<TradeoffPoint> measure_points(std::span<const Candidate> candidates,
                                          const MeasurePlan& plan, const Measuring& measuring,
                                          std::vector<std::string>& skipped) {
    std::vector<Entrant> entrants = warm_up(candidates, plan, measuring, skipped);
    fill_budgets(entrants, plan, measuring);
    double all_ms = 0.0;
    std::vector<TradeoffPoint> points;
    for (const Entrant& entrant : entrants) {
        all_ms += entrant.expected_ms * plan.repetitions;
        TradeoffPoint point;
        point.name = entrant.candidate.name;
        point.family = entrant.candidate.family;
        point.preset = entrant.candidate.preset;
        points.push_back(std::move(point));
    }
    double done_ms = 0.0;
    for (std::uint32_t round = 0; round < plan.repetitions; ++round)
        for (std::size_t i = 0; i < points.size(); ++i) {
            TradeoffPoint& point = points[i];
            measuring.report(all_ms > 0.0 ? done_ms / all_ms : 0.0, point.name);
            const MeasuredImage made =
                measuring.make(point.preset, image_seed(plan.seed, round), false);
            point.runs_ms.push_back(made.ms);
            point.runs_errors.push_back(measuring.judge(made.image));
            if (measuring.unbiased)
                if (const auto found = measuring.unbiased(made.image))
                    point.runs_unbiased.push_back(*found);
            if (round == 0) point.rays = made.rays;
            done_ms += entrants[i].expected_ms;
        }
    const TimeSpread spread = time_spread(points);
    for (TradeoffPoint& point : points) summarize(point, spread);
    std::stable_sort(
        points.begin(), points.end(),
        [](const TradeoffPoint& a, const TradeoffPoint& b) { return a.ms.median < b.ms.median; });
    return points;
}

void mark_front(std::vector<TradeoffPoint>& points, ErrorMeasure measure) {
    std::vector<CostAndError> values;
    for (const TradeoffPoint& point : points)
        values.push_back(
            {point.ms.median, point.errors.at(static_cast<std::size_t>(measure)).median});
    const std::vector<bool> on_front = pareto_front(values);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].on_front = on_front[i];
}

FrontCheck check_front(std::span<const TradeoffPoint> points, ErrorMeasure measure,
                       const MeasurePlan& plan, const Measuring& measuring, std::uint32_t rounds) {
    FrontCheck check;
    const auto kind = static_cast<std::size_t>(measure);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i].on_front) check.points.push_back({i, {}, {}});
    const auto all = static_cast<double>(check.points.size() * rounds);
    for (std::uint32_t round = 0; round < rounds; ++round)
        for (FrontCheck::Point& checked : check.points) {
            const TradeoffPoint& point = points[checked.point];
            measuring.report(check.images / all, "again: " + point.name);
            const MeasuredImage made = measuring.make(
                point.preset, image_seed(plan.seed, plan.repetitions + round), false);
            checked.ms.push_back(made.ms);
            checked.errors.push_back(measuring.judge(made.image).at(kind));
            ++check.images;
            if (within(point.ms, made.ms)) ++check.times_within;
            if (within(point.errors.at(kind), checked.errors.back())) ++check.errors_within;
        }
    return check;
}

}  // namespace weft
