// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace weft {
namespace {

/// Chooses among points by their time and one kind of error.
class PointChoice {
  public:
    PointChoice(std::span<const TradeoffPoint> points, ErrorMeasure measure)
        : points_(points), measure_(measure) {}

    /// The index of the fastest point for which `keeps` is true; of equally fast ones, that of
    /// least error.
    template <class Keeps>
    [[nodiscard]] std::optional<std::size_t> fastest(const Keeps& keeps) const {
        return best([&](std::size_t i) { return std::pair(time(i), error(i)); }, keeps);
    }
    /// The index of the point of least error for which `keeps` is true; of equally good ones, that
    /// of the fastest.
    template <class Keeps>
    [[nodiscard]] std::optional<std::size_t> nearest(const Keeps& keeps) const {
        return best([&](std::size_t i) { return std::pair(error(i), time(i)); }, keeps);
    }

  private:
    [[nodiscard]] double time(std::size_t i) const { return points_[i].ms.median; }
    [[nodiscard]] double error(std::size_t i) const {
        return error_of(points_[i], measure_).median;
    }

    /// The index of the point with the least key for which `keeps` is true. Points whose time or
    /// error is not finite are left out, since these have no order.
    template <class Key, class Keeps>
    [[nodiscard]] std::optional<std::size_t> best(const Key& key, const Keeps& keeps) const {
        std::optional<std::size_t> best;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (!std::isfinite(time(i)) || !std::isfinite(error(i)) || !keeps(points_[i])) continue;
            if (!best || key(i) < key(*best)) best = i;
        }
        return best;
    }

    std::span<const TradeoffPoint> points_;
    ErrorMeasure measure_;
};

bool any(const TradeoffPoint&) {
    return true;
}

std::string nothing_text(const std::string& question, ErrorMeasure measure) {
    return fmt::format(
        "for {} there is no answer: nothing that was measured has both a time and {}", question,
        label(measure));
}

std::string error_text(const TradeoffPoint& point, ErrorMeasure measure) {
    const Interval error = error_of(point, measure);
    return fmt::format("with {} {:.3g} (95 %: {:.3g} to {:.3g})", label(measure), error.median,
                       error.low, error.high);
}

std::string taken_text(const TradeoffPoint& point) {
    return fmt::format("in {} (95 %: {} to {})", time_text(point.ms.median),
                       time_text(point.ms.low), time_text(point.ms.high));
}

/// A budget as it was given, not rounded as measurements are.
std::string budget_text(double ms, const char* space) {
    if (ms < 1000.0) return fmt::format("{:.15g}{}ms", ms, space);
    return fmt::format("{:.15g}{}s", ms / 1000.0, space);
}

double two_digits(double value) {
    return std::strtod(fmt::format("{:.1e}", value).c_str(), nullptr);
}

}  // namespace

std::string time_text(double ms) {
    // Smaller ones do not become 1000 when they are rounded to three digits.
    constexpr double thousand = 999.5;
    if (ms < thousand) return fmt::format("{:.3g} ms", ms);
    const double seconds = ms / 1000.0;
    return seconds < thousand ? fmt::format("{:.3g} s", seconds) : fmt::format("{:.0f} s", seconds);
}

std::string preset_file_for_budget(double budget_ms) {
    return "preset-" + budget_text(budget_ms, "") + ".json";
}

std::string preset_file_for_error(double error) {
    return fmt::format("preset-error-{:.15g}.json", error);
}

TradeoffAdvice advice_for_budget(std::span<const TradeoffPoint> points, ErrorMeasure measure,
                                 double budget_ms) {
    const PointChoice choice(points, measure);
    TradeoffAdvice advice;
    advice.budget_ms = budget_ms;
    advice.point = choice.nearest([&](const TradeoffPoint& point) {
        return point.ms.median <= budget_ms && point.ms.high <= most_over_budget * budget_ms;
    });
    const std::string budget = budget_text(budget_ms, " ");
    if (advice.point) {
        const TradeoffPoint& best = points[*advice.point];
        advice.sentence = fmt::format("for {} the best is {}, {}, {}", budget, best.name,
                                      error_text(best, measure), taken_text(best));
        advice.preset_file = preset_file_for_budget(budget_ms);
        return advice;
    }
    const std::optional<std::size_t> place = choice.fastest(any);
    if (!place) {
        advice.sentence = nothing_text(budget, measure);
        return advice;
    }
    const TradeoffPoint& fastest = points[*place];
    const char* const short_of =
        fastest.ms.median <= budget_ms ? "certain enough to keep to it" : "fast enough";
    advice.sentence =
        fmt::format("for {} nothing that was measured is {}: the fastest is {}, {}, {}", budget,
                    short_of, fastest.name, error_text(fastest, measure), taken_text(fastest));
    return advice;
}

TradeoffAdvice advice_for_error(std::span<const TradeoffPoint> points, ErrorMeasure measure,
                                double error) {
    const PointChoice choice(points, measure);
    TradeoffAdvice advice;
    advice.error = error;
    advice.point = choice.fastest(
        [&](const TradeoffPoint& point) { return error_of(point, measure).median <= error; });
    const std::string wish = fmt::format("{} of at most {:.15g}", label(measure), error);
    if (advice.point) {
        const TradeoffPoint& best = points[*advice.point];
        advice.sentence = fmt::format("for {} the cheapest is {}, {}, {}", wish, best.name,
                                      taken_text(best), error_text(best, measure));
        advice.preset_file = preset_file_for_error(error);
        return advice;
    }
    const std::optional<std::size_t> place = choice.nearest(any);
    if (!place) {
        advice.sentence = nothing_text(wish, measure);
        return advice;
    }
    const TradeoffPoint& nearest = points[*place];
    advice.sentence =
        fmt::format("for {} nothing that was measured is good enough: the best is {}, {}, {}", wish,
                    nearest.name, error_text(nearest, measure), taken_text(nearest));
    return advice;
}

void add_noise_note(TradeoffAdvice& advice, std::span<const TradeoffPoint> points,
                    ErrorMeasure measure, double noise_floor) {
    constexpr double far_above = 2.0;
    if (!advice.point || !std::isfinite(noise_floor)) return;
    if (!(error_of(points[*advice.point], measure).median < far_above * noise_floor)) return;
    advice.sentence += fmt::format(
        "; the reference's own noise, {:.3g}, hides what better settings gain: --reference-spp has "
        "to be higher",
        noise_floor);
}

std::vector<double> sensible_errors(std::span<const TradeoffPoint> points, ErrorMeasure measure) {
    double least = 0.0;
    double most = 0.0;
    for (const TradeoffPoint& point : points) {
        const double error = error_of(point, measure).median;
        // 0 has no place on a logarithmic scale.
        if (!point.on_front || !(error > 0.0) || !std::isfinite(error)) continue;
        least = least > 0.0 ? std::min(least, error) : error;
        most = std::max(most, error);
    }
    std::vector<double> errors;
    if (!(most > least)) return errors;
    for (const double share : {0.75, 0.5, 0.25}) {
        const double error = two_digits(least * std::pow(most / least, share));
        if (error >= least && error <= most && (errors.empty() || error < errors.back()))
            errors.push_back(error);
    }
    return errors;
}

}  // namespace weft
