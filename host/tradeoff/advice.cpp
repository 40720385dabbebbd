// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace weft {
namespace {

const Interval& error_of(const TradeoffPoint& point, ErrorMeasure measure) {
    return point.errors.at(static_cast<std::size_t>(measure));
}

/// The index of the best point that `keeps`, by `is_better`.
template <class Keeps, class IsBetter>
std::optional<std::size_t> best_of(std::span<const TradeoffPoint> points, const Keeps& keeps,
                                   const IsBetter& is_better) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (keeps(points[i]) && (!best || is_better(points[i], points[*best]))) best = i;
    return best;
}

std::string error_text(const TradeoffPoint& point, ErrorMeasure measure) {
    const Interval& error = error_of(point, measure);
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
    // Rounded to three digits, none of these becomes a power of ten.
    constexpr double thousand = 999.5;
    if (ms < thousand) return fmt::format("{:.3g} ms", ms);
    const double seconds = ms / 1000.0;
    return seconds < thousand ? fmt::format("{:.3g} s", seconds) : fmt::format("{:.0f} s", seconds);
}

TradeoffAdvice advice_for_budget(std::span<const TradeoffPoint> points, ErrorMeasure measure,
                                 double budget_ms) {
    TradeoffAdvice advice;
    advice.budget_ms = budget_ms;
    advice.point = best_of(
        points,
        [&](const TradeoffPoint& point) {
            return point.ms.median <= budget_ms && point.ms.high <= most_over_budget * budget_ms;
        },
        [&](const TradeoffPoint& a, const TradeoffPoint& b) {
            return error_of(a, measure).median < error_of(b, measure).median;
        });
    const std::string budget = budget_text(budget_ms, " ");
    if (advice.point) {
        const TradeoffPoint& best = points[*advice.point];
        advice.sentence = fmt::format("for {} the best is {}, {}, {}", budget, best.name,
                                      error_text(best, measure), taken_text(best));
        advice.preset_file = "preset-" + budget_text(budget_ms, "") + ".json";
        return advice;
    }
    const TradeoffPoint& fastest = *std::min_element(
        points.begin(), points.end(),
        [](const TradeoffPoint& a, const TradeoffPoint& b) { return a.ms.median < b.ms.median; });
    const char* const short_of =
        fastest.ms.median <= budget_ms ? "certain enough to keep to it" : "fast enough";
    advice.sentence =
        fmt::format("for {} nothing that was measured is {}: the fastest is {}, {}, {}", budget,
                    short_of, fastest.name, error_text(fastest, measure), taken_text(fastest));
    return advice;
}

TradeoffAdvice advice_for_error(std::span<const TradeoffPoint> points, ErrorMeasure measure,
                                double error) {
    TradeoffAdvice advice;
    advice.error = error;
    advice.point = best_of(
        points,
        [&](const TradeoffPoint& point) { return error_of(point, measure).median <= error; },
        [](const TradeoffPoint& a, const TradeoffPoint& b) { return a.ms.median < b.ms.median; });
    if (advice.point) {
        const TradeoffPoint& best = points[*advice.point];
        advice.sentence =
            fmt::format("for {} of at most {:.15g} the cheapest is {}, {}, {}", label(measure),
                        error, best.name, taken_text(best), error_text(best, measure));
        advice.preset_file = fmt::format("preset-error-{:.15g}.json", error);
        return advice;
    }
    const TradeoffPoint& nearest = *std::min_element(
        points.begin(), points.end(), [&](const TradeoffPoint& a, const TradeoffPoint& b) {
            return error_of(a, measure).median < error_of(b, measure).median;
        });
    advice.sentence = fmt::format(
        "for {} of at most {:.15g} nothing that was measured is good enough: the best is {}, {}, "
        "{}",
        label(measure), error, nearest.name, error_text(nearest, measure), taken_text(nearest));
    return advice;
}

std::vector<double> sensible_errors(std::span<const TradeoffPoint> points, ErrorMeasure measure) {
    double least = 0.0;
    double most = 0.0;
    for (const TradeoffPoint& point : points) {
        const double error = error_of(point, measure).median;
        // What is 0 has no place on a logarithmic scale.
        if (!point.on_front || !(error > 0.0)) continue;
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
