// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/time_spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "base/student_t.h"
#include "tradeoff/prediction_interval.h"

namespace weft {
namespace {

/// Deviations of the times of one setting, by round.
using Deviations = std::vector<double>;

bool has_ratios(std::span<const double> times) {
    return std::all_of(times.begin(), times.end(), [](double time) { return time > 0.0; });
}

void check_times(std::span<const double> times) {
    if (times.size() < 2) throw std::invalid_argument("an interval needs two times");
    for (const double time : times)
        if (!std::isfinite(time) || time < 0.0)
            throw std::invalid_argument("a time is negative or not finite");
}

/// Median of ascending values, at least two, with the one at `left_out` left out.
double median_without(std::span<const double> sorted, std::size_t left_out) {
    const auto at = [&](std::size_t place) { return sorted[place < left_out ? place : place + 1]; };
    const std::size_t count = sorted.size() - 1;
    const std::size_t half = count / 2;
    // Halves first: the sum of two may overflow.
    return count % 2 == 1 ? at(half) : 0.5 * at(half - 1) + 0.5 * at(half);
}

/// Logarithm of the ratio of each time to the median of the others, so that no time is compared
/// with itself.
Deviations deviations_of(std::span<const double> times) {
    std::vector<std::size_t> order(times.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
    std::vector<double> sorted;
    for (const std::size_t round : order) sorted.push_back(times[round]);
    Deviations deviations(times.size());
    for (std::size_t place = 0; place < order.size(); ++place)
        deviations[order[place]] =
            std::log(sorted[place]) - std::log(median_without(sorted, place));
    return deviations;
}

/// The magnitude that one more deviation does not exceed with a probability of `coverage`: among
/// n + 1 values of any distribution, each is equally likely to have any rank. Infinity where the
/// rank is beyond the last.
double reach_by_rank(const std::vector<Deviations>& pooled, double coverage) {
    std::vector<double> magnitudes;
    for (const Deviations& deviations : pooled)
        for (const double deviation : deviations) magnitudes.push_back(std::abs(deviation));
    const double rank = std::ceil(coverage * static_cast<double>(magnitudes.size() + 1));
    if (rank > static_cast<double>(magnitudes.size()))
        return std::numeric_limits<double>::infinity();
    const auto place = magnitudes.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
    std::nth_element(magnitudes.begin(), place, magnitudes.end());
    return *place;
}

/// Mean squares of deviations that are cut off at `most`.
struct MeanSquares {
    double rounds = 0.0;  ///< of their means over the settings
    double all = 0.0;
};

MeanSquares mean_squares(const std::vector<Deviations>& pooled, double most) {
    const std::size_t rounds = pooled.front().size();
    const auto settings = static_cast<double>(pooled.size());
    MeanSquares mean;
    for (std::size_t round = 0; round < rounds; ++round) {
        double sum = 0.0;
        for (const Deviations& deviations : pooled) {
            const double deviation = std::clamp(deviations[round], -most, most);
            sum += deviation / settings;
            mean.all += deviation * deviation / settings;
        }
        mean.rounds += sum * sum;
    }
    mean.rounds /= static_cast<double>(rounds);
    mean.all /= static_cast<double>(rounds);
    return mean;
}

/// Degrees of freedom of the sum of two mean squares: that between rounds has one fewer than there
/// are rounds, that within them as many for each setting but one.
double degrees_of(const MeanSquares& mean, std::size_t settings, std::size_t rounds) {
    const double between = static_cast<double>(rounds) - 1.0;
    const double within = between * (static_cast<double>(settings) - 1.0);
    if (!(mean.all > 0.0)) return between;
    // Computed with shares of the sum, whose squares do not underflow.
    const double share = std::min(mean.rounds / mean.all, 1.0);
    const double rest = 1.0 - share;
    const double inverse =
        share * share / between + (within > 0.0 ? rest * rest / within : rest * rest / between);
    return std::max(1.0 / inverse, 1.0);
}

}  // namespace

TimeSpread time_spread(std::span<const TradeoffPoint> points, double coverage) {
    if (points.empty()) return {};
    const std::size_t rounds = points.front().runs_ms.size();
    std::vector<Deviations> pooled;
    for (const TradeoffPoint& point : points) {
        check_times(point.runs_ms);
        if (point.runs_ms.size() != rounds)
            throw std::invalid_argument("a spread needs as many times of every setting");
        if (has_ratios(point.runs_ms)) pooled.push_back(deviations_of(point.runs_ms));
    }
    if (pooled.empty()) return {};
    const double by_rank = reach_by_rank(pooled, coverage);
    const MeanSquares mean = mean_squares(pooled, by_rank);
    const double degrees = degrees_of(mean, pooled.size(), rounds);
    const double by_student =
        student_t_quantile(coverage, static_cast<std::uint32_t>(degrees)) * std::sqrt(mean.all);
    const double reach = std::isfinite(by_rank) ? std::max(by_student, by_rank) : by_student;
    return {.factor = std::min(std::exp(reach), std::numeric_limits<double>::max()),
            .degrees = degrees,
            .deviations = pooled.size() * rounds};
}

Interval time_interval(std::span<const double> times, const TimeSpread& spread, double coverage) {
    check_times(times);
    const double middle = median(times);
    if (spread.deviations == 0 || !has_ratios(times)) return prediction_interval(times, coverage);
    const Interval pooled{middle, middle / spread.factor,
                          std::min(middle * spread.factor, std::numeric_limits<double>::max())};
    const auto beyond = std::count_if(times.begin(), times.end(), [&](double time) {
        return time < pooled.low || time > pooled.high;
    });
    // One time outside may be chance, which any setting may have; a second of so few shows that the
    // setting itself scatters more.
    return beyond < 2 ? pooled : prediction_interval(times, coverage);
}

}  // namespace weft
